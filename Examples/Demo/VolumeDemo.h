// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkUnstructuredGrid;

/**
 * Images of a tetrahedral mesh with active point scalars. Returns false if one could not be
 * written.
 */
bool RunVolumeDemo(vtkUnstructuredGrid* mesh, const std::string& folder);
