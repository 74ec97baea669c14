// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Examples_Demo_VolumeDemo_h
#define meniscus_Examples_Demo_VolumeDemo_h

#include <string>

class vtkUnstructuredGrid;

/**
 * Images of a tetrahedral mesh with active point scalars. Returns false if one could not be
 * written.
 */
bool RunVolumeDemo(vtkUnstructuredGrid* mesh, const std::string& folder);

#endif
