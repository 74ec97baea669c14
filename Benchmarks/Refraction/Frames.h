// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Frames_h
#define meniscus_Frames_h

#include <ostream>
#include <string>
#include <vector>

namespace meniscus
{
namespace benchmark
{

/** Thesis Tables 4.6 to 4.9 beside the filter's frames, drawn at 512 x 512. */
void printThesisFrames(std::ostream& out);

/**
 * Frames of the filter alone per second, and processor milliseconds of one: the well of 1,445
 * vertices below 512 facets of waves that move.
 */
struct WellFrames
{
  std::string Mode;
  double PerSecond = 0.0;
  double CpuMs = 0.0;
};
std::vector<WellFrames> measureWell();

/**
 * Filter and drawing against tracing the same scene with Embree, both at an image error of half a
 * pixel.
 */
struct Race
{
  std::string Change; ///< what moves
  double OursMs = 0.0;
  double TracedMs = 0.0;
  double OursCpuMs = 0.0;
  double TracedCpuMs = 0.0;
};
struct RaceReport
{
  std::string Ours;   ///< set-up in words
  std::string Traced; ///< the same
  std::vector<Race> Races;
};
/** Empty without Embree. */
std::vector<RaceReport> runRaces();

void printRaces(std::ostream& out);

} // namespace benchmark
} // namespace meniscus

#endif
