// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surface/MeshingFiles.h"

#include <functional>
#include <string>

namespace meniscus
{

/** How the program ended. */
enum class ProcessEnd
{
  Answered,   ///< the answer is complete
  NoFiles,    ///< the files could not be written
  NotStarted, ///< there is no such program, or it cannot be run
  Crashed,    ///< ended by a signal
  NoAnswer,   ///< ended by itself, without a readable answer
  TimedOut,
  Aborted
};

/** Program that reads a task and writes an answer, and when to stop it. */
struct MesherProcess
{
  std::string Program;
  /** Seconds after which the program is ended. */
  double TimeLimit = 0.0;
  /** Called several times a second with the seconds since the start; false ends the program. */
  std::function<bool(double)> GoesOn;

  /**
   * Runs the program to its end and removes its files. If the host process is killed meanwhile,
   * the files remain, and the program goes on, except for meniscus_tetgen on Linux, which ends.
   */
  ProcessEnd Run(const MeshingTask& task, MeshingAnswer& answer) const;
};

/**
 * The program meniscus_tetgen that belongs to this library, in the build tree or installed. Empty
 * if it was not built.
 */
std::string FindTetGenProgram();

} // namespace meniscus
