// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Times vtkTetrahedraRayCastMapper and VTK's unstructured volume mappers in one run on the same
 * mesh, views and transfer function, and measures each one's error with respect to the
 * double-precision reference. --help lists further options.
 */
#include "Volume/VolumeComparison.h"
#include "Volume/VolumeOptions.h"
#include "Volume/VolumeOutput.h"
#include "Volume/VolumeProbe.h"
#include "Volume/VolumeReport.h"

#include <vtkSMPTools.h>
#include <vtkUnstructuredGrid.h>

#include <cstdlib>
#include <iostream>

using namespace meniscus::benchmark;

namespace
{

//------------------------------------------------------------------------------
// Before the first window is opened: llvmpipe reads this variable when it starts.
void useThreads(int threads)
{
  if (threads > 0)
  {
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    vtkSMPTools::Initialize(threads);
  }
}

//------------------------------------------------------------------------------
// Contestants that survive a test in another process; the reasons for the others are recorded.
std::vector<Contestant> trySurvivors(
  const std::vector<Contestant>& all, const VolumeOptions& options, std::vector<Figures>& figures)
{
  std::vector<Contestant> survivors;
  for (const Contestant& contestant : all)
  {
    std::cerr << "  trying " << contestant.Name << std::endl;
    const ProbeResult probe = probeContestant(contestant.Name, options);
    Figures entry;
    entry.Name = contestant.Name;
    entry.Survives = probe.Survives;
    entry.Fate = probe.Fate;
    entry.BytesPerCell = probe.BytesPerCell;
    figures.push_back(entry);
    if (probe.Survives)
    {
      survivors.push_back(contestant);
    }
  }
  return survivors;
}

//------------------------------------------------------------------------------
int compareAll(const VolumeOptions& options)
{
  const auto grid = makeVolumeMesh(options);
  if (!grid)
  {
    std::cerr << "no cells or no point array in " << options.Mesh << '\n';
    return EXIT_FAILURE;
  }
  std::vector<Figures> all;
  const auto contestants =
    trySurvivors(selectContestants(makeContestants(options), options.Mappers), options, all);
  VolumeComparison comparison(options, grid);
  comparison.enter(contestants);
  std::cerr << "  times ..." << std::endl;
  comparison.measureTimes();
  std::cerr << "  errors ..." << std::endl;
  comparison.measureErrors();
  for (const Figures& measured : comparison.figures())
  {
    for (Figures& figures : all)
    {
      if (figures.Name == measured.Name)
      {
        const double bytes = figures.BytesPerCell;
        figures = measured;
        figures.BytesPerCell = bytes;
      }
    }
  }
  const RunDescription description{ options.Mesh.empty() ? "generated block" : options.Mesh,
    grid->GetNumberOfCells(), comparison.device() };
  printDescription(std::cout, options, description);
  printTable(std::cout, all);
  if (!options.Json.empty() && !writeJson(options, description, all))
  {
    std::cerr << "cannot write " << options.Json << '\n';
    return EXIT_FAILURE;
  }
  if (!options.Plot.empty() && !writePlot(options, description, all))
  {
    std::cerr << "cannot write " << options.Plot << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

//------------------------------------------------------------------------------
int probe(const VolumeOptions& options)
{
  for (const Contestant& contestant : makeContestants(options))
  {
    if (contestant.Name == options.Probe)
    {
      return runProbe(contestant, options);
    }
  }
  return EXIT_FAILURE;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const VolumeOptions options = parseVolumeOptions(argc, argv);
  if (options.Help || !options.Problem.empty())
  {
    (options.Help ? std::cout : std::cerr) << options.Problem << '\n' << VolumeUsage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (!meniscus::test::hasDisplay())
  {
    std::cerr << "no display: run under xvfb-run\n";
    return EXIT_FAILURE;
  }
  useThreads(options.Threads);
  const meniscus::test::DisplayHold hold;
  if (!options.Probe.empty())
  {
    return probe(options);
  }
  if (options.Report)
  {
    printReport(std::cout, options);
    return EXIT_SUCCESS;
  }
  if (options.Growth)
  {
    printGrowth(std::cout, options);
    return EXIT_SUCCESS;
  }
  return compareAll(options);
}
