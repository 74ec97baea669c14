// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Times vtkTetrahedraRayCastMapper and VTK's unstructured volume mappers in one run on the same
 * mesh, views and transfer function, and measures each one's error with respect to the
 * double-precision reference. --help lists further options.
 */
#include "Volume/VolumeChanges.h"
#include "Volume/VolumeComparison.h"
#include "Volume/VolumeDevice.h"
#include "Volume/VolumeOptions.h"
#include "Volume/VolumeOutput.h"
#include "Volume/VolumePaper.h"
#include "Volume/VolumeProbe.h"
#include "Volume/VolumeReport.h"
#include "Volume/VolumeSteps.h"

#include <vtkSMPTools.h>
#include <vtkUnstructuredGrid.h>

#include <cstdlib>
#include <functional>
#include <iostream>

using namespace meniscus::benchmark;

namespace
{

//------------------------------------------------------------------------------
// Before the first window is opened: llvmpipe reads this variable when it starts.
void UseThreads(int threads)
{
  if (threads > 0)
  {
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    vtkSMPTools::Initialize(threads);
  }
}

//------------------------------------------------------------------------------
// Before the first native scene is made, here and in the processes of probes.
void UseInstructions(const std::string& set)
{
  if (!set.empty())
  {
    setenv("MENISCUS_INSTRUCTION_SET", set.c_str(), 1);
  }
}

//------------------------------------------------------------------------------
// Contestants that survive a test in another process (or all of them, if they are not tested); the
// reasons for the others are recorded.
std::vector<Contestant> TrySurvivors(
  const std::vector<Contestant>& all, const VolumeOptions& options, std::vector<Figures>& figures)
{
  std::vector<Contestant> survivors;
  for (const Contestant& contestant : all)
  {
    ProbeResult probe;
    probe.Survives = options.ProbeSeconds == 0;
    if (!probe.Survives)
    {
      std::cerr << "  trying " << contestant.Name << std::endl;
      probe = ProbeContestant(contestant.Name, options);
    }
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
// Mappers that were named by the end of their name and cannot be used here.
void AddMissing(const std::vector<Contestant>& selected, const VolumeOptions& options,
  std::vector<Figures>& figures)
{
  for (const std::string& word : options.Mappers)
  {
    bool found = word.empty() || word.back() != '$';
    for (const Contestant& contestant : selected)
    {
      found = found || IsSelected(contestant.Name, word);
    }
    if (!found)
    {
      Figures entry;
      entry.Name = word.substr(0, word.size() - 1);
      entry.Survives = false;
      entry.Fate = "not available here";
      figures.push_back(entry);
    }
  }
}

//------------------------------------------------------------------------------
// Writes the files that the options ask for; returns false, with a message, if one fails.
bool WriteFiles(const VolumeOptions& options, const RunDescription& description,
  const std::vector<Figures>& all, VolumeComparison& comparison)
{
  const struct
  {
    const std::string& Name;
    std::function<bool()> Write;
  } files[] = { { options.Json, [&] { return WriteJson(options, description, all); } },
    { options.Plot, [&] { return WritePlot(options, description, all); } },
    { options.TimeRows,
      [&] { return AppendTimeRows(options.TimeRows, options, description, all); } },
    { options.ErrorRows,
      [&] { return AppendErrorRows(options.ErrorRows, options, description, all); } },
    { options.Picture, [&] { return comparison.WritePictures(options.Picture); } } };
  for (const auto& file : files)
  {
    if (!file.Name.empty() && !file.Write())
    {
      std::cerr << "cannot write " << file.Name << '\n';
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
int CompareAll(const VolumeOptions& options)
{
  const auto grid = MakeVolumeMesh(options);
  if (!grid)
  {
    std::cerr << "no cells or no point array in " << options.Mesh << '\n';
    return EXIT_FAILURE;
  }
  std::vector<Figures> all;
  const auto selected = SelectContestants(MakeContestants(options), options.Mappers);
  const auto contestants = TrySurvivors(selected, options, all);
  AddMissing(selected, options, all);
  VolumeComparison comparison(options, grid);
  comparison.Enter(contestants);
  std::cerr << "  times ..." << std::endl;
  comparison.MeasureTimes();
  std::cerr << "  errors ..." << std::endl;
  comparison.MeasureErrors();
  for (const Figures& measured : comparison.GetFigures())
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
    grid->GetNumberOfCells(), comparison.GetDevice(), comparison.GetCopyBandwidth(),
    comparison.GetEmptyMs() };
  PrintDescription(std::cout, options, description);
  PrintTable(std::cout, all);
  return WriteFiles(options, description, all, comparison) ? EXIT_SUCCESS : EXIT_FAILURE;
}

//------------------------------------------------------------------------------
int MakeProbe(const VolumeOptions& options)
{
  for (const Contestant& contestant : MakeContestants(options))
  {
    if (contestant.Name == options.Probe)
    {
      return RunProbe(contestant, options);
    }
  }
  return EXIT_FAILURE;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const VolumeOptions options = ParseVolumeOptions(argc, argv);
  if (options.Help || !options.Problem.empty())
  {
    (options.Help ? std::cout : std::cerr) << options.Problem << '\n' << VolumeUsage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (!meniscus::test::HasDisplay())
  {
    std::cerr << "no display: run under xvfb-run\n";
    return EXIT_FAILURE;
  }
  UseThreads(options.Threads);
  UseInstructions(options.Instructions);
  const meniscus::test::DisplayHold hold;
  if (options.Device)
  {
    PrintDevice(std::cout);
    return EXIT_SUCCESS;
  }
  if (!options.Probe.empty())
  {
    return MakeProbe(options);
  }
  if (options.Report)
  {
    PrintReport(std::cout, options);
    return EXIT_SUCCESS;
  }
  if (options.Growth)
  {
    PrintGrowth(std::cout, options);
    return EXIT_SUCCESS;
  }
  if (options.Steps)
  {
    return PrintSteps(std::cout, options) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (options.Changes)
  {
    return PrintChanges(std::cout, options) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (!options.Paper.empty())
  {
    return DrawPaper(std::cout, options) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return CompareAll(options);
}
