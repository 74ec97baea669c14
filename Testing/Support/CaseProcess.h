// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"

namespace meniscus::test
{

/** Outcome of the cases of a family that ran in processes. */
struct ProcessResult
{
  /** Number of cases that ran, including those that did not finish. */
  int Cases = 0;
  /** Number of cases in which the process ended by itself, and of those that did not finish. */
  int Crashed = 0;
  int Stuck = 0;
  double Seconds = 0.0;
  /** Cases to examine, one line each, at most MostNotes of them. */
  std::vector<std::string> Notes;

  static constexpr std::size_t MostNotes = 10;
  void Note(const std::string& text)
  {
    if (this->Notes.size() < MostNotes)
    {
      this->Notes.push_back(text);
    }
  }
};

/** Runs one case and returns its result as one line. */
using CaseWork = std::function<std::string(int index)>;
/** Creates the objects that all cases of a process share, in that process. */
using CaseStart = std::function<CaseWork()>;
/** Receives a line that a case returned. */
using CaseTaker = std::function<void(int index, const std::string& line)>;

/** Receives a case that did not finish: its process ended by itself, or is stuck. */
using CaseLoss = std::function<void(int index, bool stuck)>;

/**
 * Runs every `stride`-th of `cases` cases in a separate process, so that a crash or an endless loop
 * costs one case only and is counted. `secondsPerCase` limits the time of a case.
 */
void RunCases(int cases, int stride, double secondsPerCase, const CaseStart& start,
  const CaseTaker& take, ProcessResult& result, const CaseLoss& lose = nullptr);

} // namespace meniscus::test
