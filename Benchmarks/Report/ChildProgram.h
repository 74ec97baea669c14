// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Programs in processes of their own, whose crash or endless loop ends nothing else. */
#pragma once

#include <string>
#include <vector>

namespace meniscus::report
{

struct ChildEnd
{
  bool Exited = false; ///< by itself, with Status
  int Status = -1;
  std::string Fate; ///< reason if it did not exit with 0; otherwise empty
  double Seconds = 0.0;
  double PeakBytes = 0.0; ///< largest resident memory
};

struct ChildProgram
{
  std::vector<std::string> Command;
  std::string Variable; ///< NAME=VALUE added to the environment; may be empty
  std::string Output;   ///< files for standard output and standard error
  std::string Errors;
  double SilentSeconds = 900.0; ///< a program whose files do not grow for so long is ended
};

ChildEnd RunChild(const ChildProgram& program);

/** Contents of a file; empty if it cannot be read. */
std::string ReadText(const std::string& name);

} // namespace meniscus::report
