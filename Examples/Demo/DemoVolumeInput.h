// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <string>

class vtkUnstructuredGrid;

/**
 * A non-convex tetrahedral mesh with a scalar field: a ring with lobes, a closed implicit surface
 * whose inside VTK tetrahedralises.
 */
vtkSmartPointer<vtkUnstructuredGrid> MakeDemoMesh();

/**
 * The mesh of a .vtu file with cells of any types, with active point scalars: its first array of
 * one component; if there is no point array, a cell array that is converted to point data. Returns
 * null, with a message on standard error, if there is none.
 */
vtkSmartPointer<vtkUnstructuredGrid> ReadDemoMesh(const std::string& file);
