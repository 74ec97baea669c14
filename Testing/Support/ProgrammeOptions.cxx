// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProgrammeOptions.h"

namespace meniscus::test
{

const char* const ProgrammeUsage =
  "  --seed N           seed of all random numbers (default 1)\n"
  "  --case N           only this case of each group\n"
  "  --seconds N        a case that takes longer is stuck (default 300)\n"
  "  --report FILE      write the tables to a file, too\n";

namespace
{

bool ReadOption(const std::string& key, const std::string& value, ProgrammeOptions& options)
{
  if (key == "--intensity")
    return ReadNumber(value, options.Intensity) && options.Intensity > 0.0;
  if (key == "--seed")
    return ReadNumber(value, options.Seed);
  if (key == "--case")
    return ReadNumber(value, options.Case);
  if (key == "--seconds")
    return ReadNumber(value, options.Seconds) && options.Seconds > 0.0;
  std::string* const text = key == options.GroupOption ? &options.Group
    : key == "--report"                                ? &options.Report
                                                       : nullptr;
  if (text)
  {
    *text = value;
  }
  return text != nullptr;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int RunProgramme(int argc, char* argv[], const char* usage, ProgrammeOptions& options,
  const OptionReader& readMore, const ProgrammeRunner& run)
{
  for (int i = 1; i < argc; i += 2)
  {
    const std::string key = argv[i];
    if (key == "--help" || key == "-h")
    {
      std::cout << usage << ProgrammeUsage;
      return EXIT_SUCCESS;
    }
    const std::string value = i + 1 < argc ? argv[i + 1] : "";
    if (i + 1 >= argc || !(readMore(key, value) || ReadOption(key, value, options)))
    {
      std::cerr << "unknown option, or bad or missing value: " << key << ' ' << value << '\n'
                << usage << ProgrammeUsage;
      return EXIT_FAILURE;
    }
  }
  std::cout << "intensity " << options.Intensity << ", seed " << options.Seed << "\n\n";
  std::ostringstream text;
  const bool good = run(options.Report.empty() ? std::cout : text);
  if (!options.Report.empty())
  {
    std::cout << text.str();
    std::ofstream file(options.Report);
    file << text.str();
    if (!file.good())
    {
      std::cerr << "cannot write " << options.Report << '\n';
      return EXIT_FAILURE;
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace meniscus::test
