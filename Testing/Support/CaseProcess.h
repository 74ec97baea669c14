// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_CaseProcess_h
#define meniscus_CaseProcess_h

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace meniscus
{
namespace test
{

/** What became of the cases of a family as processes. */
struct ProcessResult
{
  /** All that ran, with those that did not come to an end. */
  int Cases = 0;
  /** Cases in which the process ended by itself, and cases in which it did not come to an end. */
  int Crashed = 0;
  int Stuck = 0;
  double Seconds = 0.0;
  /** What is to be looked at, one line each, at most MostNotes of them. */
  std::vector<std::string> Notes;

  static constexpr std::size_t MostNotes = 10;
  void note(const std::string& text)
  {
    if (this->Notes.size() < MostNotes)
    {
      this->Notes.push_back(text);
    }
  }
};

/** Runs one case and returns what came of it as one line. */
using CaseWork = std::function<std::string(int index)>;
/** Makes what all cases of a process share, in that process. */
using CaseStart = std::function<CaseWork()>;
/** Takes a line that a case returned. */
using CaseTaker = std::function<void(int index, const std::string& line)>;

/** Takes a case that came to no end: its process ended by itself, or is stuck. */
using CaseLoss = std::function<void(int index, bool stuck)>;

/**
 * Runs every `stride`-th of `cases` cases in a process of its own, so that a crash or an endless
 * loop costs one case and is counted. A case may take the given time.
 */
void runCases(int cases, int stride, double secondsPerCase, const CaseStart& start,
  const CaseTaker& take, ProcessResult& result, const CaseLoss& lose = nullptr);

} // namespace test
} // namespace meniscus

#endif
