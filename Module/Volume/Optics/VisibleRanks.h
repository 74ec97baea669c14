// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

class VisibleScalars;

/**
 * VisibleScalars::Meets() for many cells: scalars are replaced by their ranks among the ends of the
 * visible ranges, two comparisons of which tell whether a cell can be seen.
 */
class VisibleRanks
{
public:
  /**
   * Twice the number of ends below the scalar, plus one if it is an end itself. Scalars of the same
   * rank are seen alike.
   */
  using Rank = std::uint32_t;
  /** Rank of NaN. */
  static constexpr Rank Unknown = 0xffffffffu;

  explicit VisibleRanks(const VisibleScalars& visible);

  Rank RankOf(float scalar) const;
  std::vector<Rank> RanksOf(const std::vector<float>& scalars, const RangeLoop& loop) const;

  /** VisibleScalars::Meets() of scalars with these ranks; `highest` must be known. */
  bool Meets(Rank lowest, Rank highest) const
  {
    return lowest == highest ? this->SeenAlone[lowest] != 0 : highest >= this->FirstSeen[lowest];
  }
  /** True if no scalar is NaN and every cell with scalars in the range of these can be seen. */
  bool MeetsAll(const std::vector<float>& scalars, const RangeLoop& loop) const;

private:
  /** Ends of the visible ranges, ascending. */
  std::vector<float> Ends;
  /** Nonzero for each rank that can be seen by itself. */
  std::vector<std::uint8_t> SeenAlone;
  /** For each rank the lowest rank above it with which it can be seen. */
  std::vector<Rank> FirstSeen;
};

}
