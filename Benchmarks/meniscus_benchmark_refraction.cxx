// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Accuracy of FLAT_FACETS and CURVED compared with the thesis's tables, their cost as membrane and
 * object grow, and frames of the filter compared with ray tracing by Embree. The program prints its
 * measurements and does not judge them.
 */
#include "Refraction/Accuracy.h"
#include "Refraction/Frames.h"
#include "Refraction/Growth.h"
#include "Refraction/PassTables.h"
#include "Refraction/RefractionOptions.h"
#include "Refraction/RefractionReport.h"
#include "Refraction/Rivals.h"
#include "VolumeScene.h"

#include <vtkSMPTools.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

using namespace meniscus::benchmark;

namespace
{

//------------------------------------------------------------------------------
bool MeasureTables(const RefractionOptions& options)
{
  std::string json = "{\n  \"program\": \"meniscus_benchmark_refraction\",\n"
                     "  \"compiler\": \"" __VERSION__ "\",\n  \"threads\": 1";
  if (options.Pass)
  {
    std::cout << options.Threads << " threads\n\n";
    json += ",\n  \"pass_threads\": " + std::to_string(options.Threads) + ",\n" +
      PrintPassTables(std::cout);
  }
  if (options.Thesis)
  {
    json += ",\n" + RunThesisTables();
  }
  if (options.Growth)
  {
    const std::string growth = RunGrowth(options);
    if (growth.empty())
    {
      return false;
    }
    json += ",\n" + growth;
  }
  json += "\n}\n";
  if (!options.Json.empty())
  {
    std::ofstream file(options.Json);
    if (!(file << json).flush())
    {
      std::cerr << "cannot write " << options.Json << '\n';
      return false;
    }
  }
  return true;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const RefractionOptions options = ParseRefractionOptions(argc, argv);
  if (options.Help || !options.Problem.empty())
  {
    (options.Help ? std::cout : std::cerr) << options.Problem << '\n' << RefractionUsage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  const bool draws = options.Frames || options.Report || options.Pass || !options.Plot.empty() ||
    !options.Picture.empty() || !options.Rivals.empty();
  if (draws && !meniscus::test::HasDisplay())
  {
    std::cerr << "no display: run under xvfb-run\n";
    return EXIT_FAILURE;
  }
  // Before the first window is opened: llvmpipe reads this variable when it starts.
  setenv("LP_NUM_THREADS", std::to_string(options.Threads).c_str(), 1);
  vtkSMPTools::Initialize(options.Threads);
  if ((options.Thesis || options.Growth || options.Pass) && !MeasureTables(options))
  {
    return EXIT_FAILURE;
  }
  if (!options.Picture.empty() && !WritePoolPicture(options.Picture))
  {
    std::cerr << "cannot write " << options.Picture << '\n';
    return EXIT_FAILURE;
  }
  if (!options.Rivals.empty() && !CompareRivals(options.Rivals, std::cout))
  {
    std::cerr << "no Embree in this build, or cannot write to " << options.Rivals << '\n';
    return EXIT_FAILURE;
  }
  if (options.Frames)
  {
    PrintThesisFrames(std::cout);
    PrintRaces(std::cout);
  }
  if (options.Report)
  {
    PrintRefractionReport(std::cout, options);
  }
  return EXIT_SUCCESS;
}
