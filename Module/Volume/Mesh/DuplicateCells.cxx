// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/DuplicateCells.h"

#include "Common/BlockLoop.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

using Quad = std::array<std::int32_t, 4>;

std::uint32_t CodeOf(MortonKey key)
{
  return static_cast<std::uint32_t>(key >> 32);
}

/** 30-bit hash of a position. Equal positions have equal hashes; zeros of both signs are equal. */
std::uint32_t HashOf(const glm::dvec3& position)
{
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double coordinate = position[axis] + 0.0;
    std::uint64_t bits;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    hash = (hash ^ bits ^ (bits >> 29)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return static_cast<std::uint32_t>(hash >> 2) & 0x3FFFFFFFu;
}

/** Marks the duplicates among the keys [first, last), which all have the same code. */
void MarkDuplicates(const std::vector<MortonKey>& keys, std::size_t first, std::size_t last,
  const std::function<Quad(std::size_t)>& verticesOf,
  std::vector<std::pair<Quad, std::size_t>>& cells, std::vector<std::uint8_t>& duplicate)
{
  cells.clear();
  for (std::size_t i = first; i < last; ++i)
  {
    cells.emplace_back(verticesOf(IndexOf(keys[i])), i);
  }
  std::sort(cells.begin(), cells.end());
  for (std::size_t i = 1; i < cells.size(); ++i)
  {
    duplicate[cells[i].second] = cells[i].first == cells[i - 1].first;
  }
}

}

//------------------------------------------------------------------------------
std::vector<std::int32_t> FindLowestCoincident(std::size_t count,
  const std::function<glm::dvec3(std::size_t)>& getPosition, const RangeLoop& loop)
{
  std::vector<MortonKey> keys(count);
  ForEachBlock(count, loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t v = first; v < last; ++v)
      {
        keys[v] = MakeMortonKey(HashOf(getPosition(v)), v);
      }
    });
  SortByCode(keys, loop);
  std::vector<std::int32_t> lowest(count);
  std::iota(lowest.begin(), lowest.end(), 0);
  for (std::size_t i = 1; i < count; ++i)
  {
    // Indices are ascending in each run of equal hashes.
    const std::size_t vertex = IndexOf(keys[i]);
    for (std::size_t other = i; other > 0 && CodeOf(keys[other - 1]) == CodeOf(keys[i]); --other)
    {
      const std::size_t before = IndexOf(keys[other - 1]);
      if (getPosition(before) == getPosition(vertex))
      {
        lowest[vertex] = lowest[before];
        break;
      }
    }
  }
  return lowest;
}

//------------------------------------------------------------------------------
std::size_t RemoveDuplicateCells(std::vector<MortonKey>& keys,
  const std::function<Quad(std::size_t)>& verticesOf, const RangeLoop& loop)
{
  std::vector<std::uint8_t> duplicate(keys.size());
  std::vector<std::size_t> counts(NumberOfBlocks(keys.size()), 0);
  const auto continues = [&keys](std::size_t i)
  { return i > 0 && i < keys.size() && CodeOf(keys[i]) == CodeOf(keys[i - 1]); };
  ForEachBlock(keys.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      std::vector<std::pair<Quad, std::size_t>> cells;
      // A run belongs to the block in which it begins.
      for (std::size_t i = first; i < last; ++i)
      {
        std::size_t end = i + 1;
        for (; !continues(i) && continues(end); ++end)
        {
        }
        if (end - i > 1)
        {
          MarkDuplicates(keys, i, end, verticesOf, cells, duplicate);
          counts[block] += static_cast<std::size_t>(
            std::count(duplicate.begin() + i, duplicate.begin() + end, std::uint8_t{ 1 }));
        }
      }
    });
  const std::size_t removed = std::accumulate(counts.begin(), counts.end(), std::size_t{ 0 });
  if (removed > 0)
  {
    std::size_t next = 0;
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
      keys[next] = keys[i];
      next += duplicate[i] ? 0 : 1;
    }
    keys.resize(next);
  }
  return removed;
}

}
