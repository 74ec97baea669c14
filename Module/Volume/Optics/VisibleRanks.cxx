// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/VisibleRanks.h"

#include "Common/BlockLoop.h"
#include "Volume/Optics/VisibleScalars.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

//------------------------------------------------------------------------------
VisibleRanks::VisibleRanks(const VisibleScalars& visible)
  : Ends(visible.ListEnds())
{
  // Ranks are in the same order as scalars, so that the ranges can be given in ranks.
  const VisibleScalars ofRanks =
    visible.Mapped([this](float end) { return static_cast<float>(this->RankOf(end)); });
  const auto meets = [&ofRanks](Rank lowest, Rank highest)
  { return ofRanks.Meets(static_cast<float>(lowest), static_cast<float>(highest)); };
  const auto size = static_cast<Rank>(2 * this->Ends.size() + 1);
  Rank first = 0;
  for (Rank rank = 0; rank < size; ++rank)
  {
    this->SeenAlone.push_back(meets(rank, rank) ? 1 : 0);
    // A larger range of different scalars is seen if a part of it is.
    first = std::max(first, rank + 1);
    while (first < size && !meets(rank, first))
    {
      ++first;
    }
    this->FirstSeen.push_back(first);
  }
}

//------------------------------------------------------------------------------
VisibleRanks::Rank VisibleRanks::RankOf(float scalar) const
{
  if (std::isnan(scalar))
  {
    return Unknown;
  }
  const auto end = std::lower_bound(this->Ends.begin(), this->Ends.end(), scalar);
  return static_cast<Rank>(2 * (end - this->Ends.begin())) +
    (end != this->Ends.end() && *end == scalar ? 1 : 0);
}

//------------------------------------------------------------------------------
std::vector<VisibleRanks::Rank> VisibleRanks::RanksOf(
  const std::vector<float>& scalars, const RangeLoop& loop) const
{
  std::vector<Rank> ranks(scalars.size());
  ForEachBlock(scalars.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      std::transform(scalars.begin() + first, scalars.begin() + last, ranks.begin() + first,
        [this](float scalar) { return this->RankOf(scalar); });
    });
  return ranks;
}

//------------------------------------------------------------------------------
bool VisibleRanks::MeetsAll(const std::vector<float>& scalars, const RangeLoop& loop) const
{
  struct Range
  {
    float Lowest = std::numeric_limits<float>::infinity();
    float Highest = -std::numeric_limits<float>::infinity();
    bool IsKnown = true;
  };
  std::vector<Range> blocks(NumberOfBlocks(scalars.size()));
  ForEachBlock(scalars.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      Range range;
      for (std::size_t i = first; i < last; ++i)
      {
        range.Lowest = std::min(range.Lowest, scalars[i]);
        range.Highest = std::max(range.Highest, scalars[i]);
        range.IsKnown = range.IsKnown && !std::isnan(scalars[i]);
      }
      blocks[block] = range;
    });
  Range all;
  for (const Range& range : blocks)
  {
    all.Lowest = std::min(all.Lowest, range.Lowest);
    all.Highest = std::max(all.Highest, range.Highest);
    all.IsKnown = all.IsKnown && range.IsKnown;
  }
  bool seen = all.IsKnown;
  const Rank highest = this->RankOf(all.Highest);
  for (Rank rank = this->RankOf(all.Lowest); seen && rank <= highest; ++rank)
  {
    seen = this->SeenAlone[rank] != 0 && (rank == highest || this->FirstSeen[rank] == rank + 1);
  }
  return seen;
}

}
