// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_StressOptions_h
#define meniscus_StressOptions_h

#include <cstdint>
#include <functional>
#include <ostream>
#include <sstream>
#include <string>

namespace meniscus
{
namespace test
{

/// What every stress programme takes on its command line.
struct StressOptions
{
  double Intensity = 1.0;
  std::uint64_t Seed = 1;
  std::string Family;
  int Case = -1;
  double Seconds = 300.0;
  std::string Report;

  bool has(const std::string& family) const
  {
    return family.find(this->Family) != std::string::npos;
  }
};

/// Their usage, one line each.
extern const char* const StressOptionsUsage;

template <typename Number>
bool readNumber(const std::string& text, Number& value)
{
  std::istringstream in(text);
  return in >> value && in.eof() && value >= Number(0);
}

/// Takes an option that only one programme has; false if it is unknown or its value is bad.
using OptionReader = std::function<bool(const std::string& key, const std::string& value)>;

/// Prints the tables and returns whether all is good.
using StressRunner = std::function<bool(std::ostream&)>;

/**
 * main(): reads the options, calls `run` with a stream that goes to standard output and to the
 * file of --report, and returns the exit status: success if all is good.
 */
int runStressProgramme(int argc, char* argv[], const char* usage, StressOptions& options,
  const OptionReader& readMore, const StressRunner& run);

} // namespace test
} // namespace meniscus

#endif
