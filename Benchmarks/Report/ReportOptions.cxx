// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReportOptions.h"

#include <map>

namespace meniscus::report
{

const char* const ReportUsage =
  "usage: meniscus_report [options]\n"
  "\n"
  "Runs the tests with every backend and the benchmarks, each in a process of its own, and writes\n"
  "report.md, report.json and pictures. Needs an X display.\n"
  "\n"
  "  --quick          every 32nd test, one view, small windows; the rest is listed as left out\n"
  "  --output FOLDER  folder of the report; must not exist or be empty (default report)\n"
  "  --programs FOLDER  test and benchmark programs (default: that of this program)\n"
  "  --data FOLDER    meshes to measure, .vtu files (default: a generated mesh alone)\n"
  "  --about FILE     lines \"name: value\" to include\n"
  "  --driver TEXT    sentence on the choice of the graphics driver, to include\n"
  "  --help           this text\n"
  "\n"
  "Exit status: 0 if the report is complete and no test failed; 1 if it could not be written or\n"
  "something is missing; 2 if it is complete and a test failed.\n";

//------------------------------------------------------------------------------
ReportOptions ParseReportOptions(int argc, char* argv[])
{
  ReportOptions options;
  const std::string self = argv[0];
  const std::size_t slash = self.rfind('/');
  options.Programs = slash == std::string::npos ? "." : self.substr(0, slash);
  const std::map<std::string, std::string*> texts{ { "--output", &options.Output },
    { "--programs", &options.Programs }, { "--data", &options.Data }, { "--about", &options.About },
    { "--driver", &options.Driver } };
  for (int i = 1; i < argc; ++i)
  {
    const std::string key = argv[i];
    const auto text = texts.find(key);
    if (key == "--quick" || key == "--help")
    {
      (key == "--quick" ? options.Quick : options.Help) = true;
    }
    else if (text != texts.end() && i + 1 < argc)
    {
      *text->second = argv[++i];
    }
    else
    {
      options.Problem = "unknown option or missing value: " + key;
      return options;
    }
  }
  return options;
}

} // namespace meniscus::report
