// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CaseProcess.h"
#include "StressCheck.h"

namespace meniscus::test
{

struct FamilyResult : ProcessResult
{
  StressTally Tally;
  int Skipped = 0;

  bool IsGood() const
  {
    return this->Tally.Lost == 0 && this->Tally.Wrong == 0 && this->Crashed == 0 &&
      this->Stuck == 0;
  }
};

/**
 * Runs every `stride`-th case of a family in a separate process. `secondsPerCase` limits the time
 * of a case.
 */
FamilyResult RunFamily(
  const StressFamily& family, const std::string& caster, int stride, double secondsPerCase);

} // namespace meniscus::test
