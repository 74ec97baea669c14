// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Frames.h"

#include "Timing.h"
#include "WellScene.h"

#include <vtkRefractedGeometryFilter.h>

#include <iomanip>

namespace meniscus::benchmark
{

namespace
{

constexpr int Frames = 40;

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<WellFrames> MeasureWell()
{
  std::vector<WellFrames> result;
  const struct
  {
    const char* Name;
    bool All;
    double Tolerance;
  } modes[] = { { "FIRST_IMAGE", false, 0.005 }, { "ALL_IMAGES, 0.05 degrees", true, 0.05 },
    { "ALL_IMAGES, 0.005 degrees", true, 0.005 } };
  for (const auto& mode : modes)
  {
    WellScene scene(16, 16);
    scene.GetFilter()->SetImages(mode.All);
    scene.GetFilter()->SetAngularTolerance(mode.Tolerance);
    std::vector<Seconds> times;
    for (int i = 0; i < 4 * Frames; ++i)
    {
      scene.MoveMembrane(0.1 * i);
      times.push_back(TimeOnce([&] { scene.Update(); }));
    }
    const Seconds frame = MedianOf(times);
    result.push_back({ mode.Name, 1.0 / frame.Wall, 1e3 * frame.Cpu });
  }
  return result;
}

//------------------------------------------------------------------------------
void PrintRaces(std::ostream& out)
{
  const auto reports = RunRaces();
  if (reports.empty())
  {
    out << "against Embree: skipped, built without it\n";
  }
  out << std::fixed << std::setprecision(2);
  for (const RaceReport& report : reports)
  {
    out << report.Ours << "\nagainst " << report.Traced
        << "\n| what moves | filter and drawing ms | tracing ms | ratio | CPU ms | CPU ms | ratio "
           "|\n|---|---|---|---|---|---|---|\n";
    for (const Race& race : report.Races)
    {
      out << "| " << race.Change << " | " << race.OursMs << " | " << race.TracedMs << " | "
          << race.TracedMs / race.OursMs << " | " << race.OursCpuMs << " | " << race.TracedCpuMs
          << " | " << race.TracedCpuMs / race.OursCpuMs << " |\n";
    }
    out << '\n';
  }
}

} // namespace meniscus::benchmark
