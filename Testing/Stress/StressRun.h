// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_StressRun_h
#define meniscus_StressRun_h

#include "StressCheck.h"

#include <string>
#include <vector>

namespace meniscus
{
namespace test
{

struct FamilyResult
{
  StressTally Tally;
  int Cases = 0;
  int Skipped = 0;
  /// Cases in which the process ended by itself, and cases in which it did not come to an end.
  int Crashed = 0;
  int Stuck = 0;
  double Seconds = 0.0;
  /// What is to be looked at, one line each, at most MostNotes of them.
  std::vector<std::string> Notes;

  static constexpr std::size_t MostNotes = 10;
  bool isGood() const
  {
    return this->Tally.Lost == 0 && this->Tally.Wrong == 0 && this->Crashed == 0 &&
      this->Stuck == 0;
  }
};

/**
 * Runs every `stride`-th case of a family in a process of its own, so that a crash or an endless
 * loop costs one case and is counted. A case may take the given time.
 */
FamilyResult runFamily(
  const StressFamily& family, const std::string& caster, int stride, double secondsPerCase);

} // namespace test
} // namespace meniscus

#endif
