// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Report on one machine: all numeric tests with every backend, errors, frames, large meshes, and
 * the refraction pass. --help lists the options.
 */
#include "Machine.h"
#include "Measurements.h"
#include "ReportOptions.h"
#include "ReportText.h"
#include "TestRuns.h"

#include <filesystem>
#include <iostream>

using namespace meniscus::report;

namespace
{

constexpr int Incomplete = 1;
constexpr int TestsFailed = 2;

//------------------------------------------------------------------------------
// Old logs must not count as results of this run: the folder has to be new or empty.
bool MakeFolders(const std::string& output)
{
  std::error_code error;
  std::filesystem::create_directories(output, error);
  if (error || !std::filesystem::is_empty(output, error))
  {
    return false;
  }
  return std::filesystem::create_directory(output + "/logs", error) &&
    std::filesystem::create_directory(output + "/pictures", error);
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const ReportOptions options = ParseReportOptions(argc, argv);
  if (options.Help || !options.Problem.empty())
  {
    (options.Help ? std::cout : std::cerr) << options.Problem << '\n' << ReportUsage;
    return options.Help ? 0 : Incomplete;
  }
  if (!MakeFolders(options.Output))
  {
    std::cerr << "cannot make " << options.Output << ", or it is not empty\n";
    return Incomplete;
  }
  ReportText report;
  report.Write(std::string("# Report of Meniscus") + (options.Quick ? " (quick)" : "") + "\n\n");
  report.AddMember("quick", options.Quick ? "true" : "false");
  const std::string renderer = DescribeMachine(options, report);
  const bool software = IsSoftware(renderer);
  report.AddMember("software_rendering", software ? "true" : "false");
  report.Write(renderer.empty() ? "\nThe graphics device is unknown.\n"
      : software
      ? "\n**Software rendering: OpenGL runs on the processor here. These are no figures of a "
        "graphics card.**\n"
      : "\nOpenGL runs on: " + renderer + "\n");
  RunTests(options, report);
  MeasureAll(options, report);
  if (!report.WriteFiles(options.Output))
  {
    std::cerr << "cannot write the report\n";
    return Incomplete;
  }
  std::cerr << "report: " << options.Output << "/report.md\n";
  return !report.IsComplete() ? Incomplete : report.GetFailedTests() > 0 ? TestsFailed : 0;
}
