// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DemoVolumeInput_h
#define DemoVolumeInput_h

#include "vtkSmartPointer.h"

#include <string>

class vtkUnstructuredGrid;

/**
 * A non-convex tetrahedral mesh with a scalar field: a ring with lobes, a closed implicit surface
 * whose inside VTK tetrahedralises.
 */
vtkSmartPointer<vtkUnstructuredGrid> MakeDemoMesh();

/**
 * The mesh of a .vtu file, whatever its cells, with active point scalars: its first array of one
 * component, a cell array taken to the points if there is no point array. Null, with a message on
 * standard error, if there is none.
 */
vtkSmartPointer<vtkUnstructuredGrid> ReadDemoMesh(const std::string& file);

#endif
