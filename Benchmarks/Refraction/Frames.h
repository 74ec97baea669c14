// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace meniscus::benchmark
{

/** Thesis Tables 4.6 to 4.9 next to the filter's frames, drawn at 512 x 512. */
void PrintThesisFrames(std::ostream& out);

/**
 * Frames per second of the filter alone, and processor milliseconds of one: the well of 1,445
 * vertices below 512 facets of moving waves.
 */
struct WellFrames
{
  std::string Mode;
  double PerSecond = 0.0;
  double CpuMs = 0.0;
};
std::vector<WellFrames> MeasureWell();

/**
 * Filter and drawing compared with tracing the same scene by Embree, both at an image error of half
 * a pixel.
 */
struct Race
{
  std::string Change; ///< the part that moves
  double OursMs = 0.0;
  double TracedMs = 0.0;
  double OursCpuMs = 0.0;
  double TracedCpuMs = 0.0;
};
struct RaceReport
{
  std::string Ours;   ///< set-up as text
  std::string Traced; ///< set-up as text
  std::vector<Race> Races;
};
/** Empty without Embree. */
std::vector<RaceReport> RunRaces();

void PrintRaces(std::ostream& out);

} // namespace meniscus::benchmark
