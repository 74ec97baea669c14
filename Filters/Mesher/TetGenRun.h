// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surface/MeshingFiles.h"

#include <string>

class vtkAlgorithm;

namespace meniscus
{

/**
 * Distance from a triangle's plane at which TetGen still takes a point for coplanar, relative to
 * the size of the surface: its default for the switch T. VTK adds no points at all, and rounding of
 * the volumes is far below.
 */
constexpr double CoplanarTolerance = 1e-8;

/** File name of TetGen's program: `set` or, if it is null, the program of the installation. */
std::string ChooseTetGenProgram(const char* set);

/**
 * Runs TetGen for a filter, which gets its progress, its error message and its abort. Returns false
 * after an error or an abort.
 * @param timeLimit seconds after which TetGen is ended.
 */
bool RunTetGen(vtkAlgorithm* filter, const std::string& program, double timeLimit,
  const MeshingTask& task, TetrahedronCells& cells);

} // namespace meniscus
