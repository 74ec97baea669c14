// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef VolumeDemo_h
#define VolumeDemo_h

#include <string>

class vtkUnstructuredGrid;

/** Pictures of a tetrahedral mesh with active point scalars. False if one could not be written. */
bool RunVolumeDemo(vtkUnstructuredGrid* mesh, const std::string& folder);

#endif
