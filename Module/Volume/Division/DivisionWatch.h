// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/BlockLoop.h"
#include "Common/RangeLoop.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace meniscus
{

/**
 * Loops of a division that report progress and may be aborted. Reports come from the calling
 * thread, after each step of a round and within long loops. After an abort the loops do nothing
 * more, and results of the step are incomplete.
 */
class DivisionWatch
{
public:
  /** Items of a loop between two reports: a tenth of a second of work on one processor, or less. */
  static constexpr std::size_t Portion = 16 * BlockSize;

  /** @param progress is called with the fraction done, an estimate; returns false to abort. */
  DivisionWatch(const RangeLoop& loop, const std::function<bool(double)>& progress)
    : Loop(loop)
    , Progress(progress)
  {
  }

  /** Runs a step that is a share of a round. Returns false if the division is aborted. */
  template <typename Step>
  bool Run(double share, const Step& step)
  {
    this->Share = share;
    step();
    this->Done += this->Share;
    this->Share = 0.0;
    return this->Report(0.0);
  }

  /** As meniscus::ForEachBlock, with the same blocks. */
  template <typename Body>
  void ForEachBlock(std::size_t count, const Body& body)
  {
    this->Begin();
    for (std::size_t first = 0; first < count && this->GoesOn(first, count); first += Portion)
    {
      const std::size_t start = first / BlockSize;
      meniscus::ForEachBlock(std::min(Portion, count - first), this->Loop,
        [&body, first, start](std::size_t block, std::size_t begin, std::size_t end)
        { body(start + block, first + begin, first + end); });
    }
    this->End();
  }

  /** Calls visit(i) for i from 0 to `count`, on the calling thread. */
  template <typename Visit>
  void ForEach(std::size_t count, const Visit& visit)
  {
    this->Begin();
    for (std::size_t i = 0; i < count && this->GoesOn(i, count); ++i)
    {
      visit(i);
    }
    this->End();
  }

private:
  // Nobody knows how many loops a step has. Each loop gets half of the progress that is left to the
  // step.
  void Begin() { this->Next = Portion; }
  void End()
  {
    this->Done += 0.5 * this->Share;
    this->Share *= 0.5;
  }

  bool GoesOn(std::size_t done, std::size_t count)
  {
    if (done >= this->Next)
    {
      this->Next = done + Portion;
      this->Report(static_cast<double>(done) / static_cast<double>(count));
    }
    return !this->Aborted;
  }

  // Progress grows ever more slowly: the first rounds are short, and most divisions end within
  // thirty.
  bool Report(double part)
  {
    const double rounds = this->Done + 0.5 * part * this->Share;
    this->Aborted = this->Aborted || !this->Progress(1.0 - std::exp2(-rounds / 8.0));
    return !this->Aborted;
  }

  const RangeLoop& Loop;
  const std::function<bool(double)>& Progress;
  double Done = 0.0;  ///< rounds
  double Share = 0.0; ///< rest of the step's share of a round
  std::size_t Next = Portion;
  bool Aborted = false;
};

}
