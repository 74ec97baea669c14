// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"

namespace meniscus::test
{

/** Command line options of all programmes of random cases. */
struct ProgrammeOptions
{
  double Intensity = 1.0;
  std::uint64_t Seed = 1;
  /** Name of the option that selects groups of cases: "--family" or "--relation". */
  std::string GroupOption = "--family";
  /** Text in the names of the groups to run; empty: all. */
  std::string Group;
  int Case = -1;
  double Seconds = 300.0;
  std::string Report;

  bool Has(const std::string& group) const { return group.find(this->Group) != std::string::npos; }
};

/** Usage of these options, one line each. */
extern const char* const ProgrammeUsage;

template <typename Number>
bool ReadNumber(const std::string& text, Number& value)
{
  std::istringstream in(text);
  return in >> value && in.eof() && value >= Number(0);
}

/**
 * Reads an option that only one programme has; returns false if it is unknown or its value is
 * invalid.
 */
using OptionReader = std::function<bool(const std::string& key, const std::string& value)>;

/** Prints the tables and returns true if nothing failed. */
using ProgrammeRunner = std::function<bool(std::ostream&)>;

/**
 * main(): reads the options, calls `run` with a stream that goes to standard output and to the file
 * of --report, and returns the exit status: success if nothing failed.
 */
int RunProgramme(int argc, char* argv[], const char* usage, ProgrammeOptions& options,
  const OptionReader& readMore, const ProgrammeRunner& run);

} // namespace meniscus::test
