// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/DuplicateCells.h"

#include "Common/BlockLoop.h"

#include <algorithm>
#include <cstring>
#include <numeric>

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

/** Vertices of a cell in two words, which compare in one step each, and its place in a run. */
struct RunCell
{
  std::uint64_t Low;
  std::uint64_t High;
  std::size_t Place;

  RunCell(const Quad& vertices, std::size_t place)
    : Low(Join(vertices[0], vertices[1]))
    , High(Join(vertices[2], vertices[3]))
    , Place(place)
  {
  }
  bool HasVerticesOf(const RunCell& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
  bool operator<(const RunCell& other) const
  {
    return this->Low != other.Low ? this->Low < other.Low
      : this->High != other.High  ? this->High < other.High
                                  : this->Place < other.Place;
  }

private:
  static std::uint64_t Join(std::int32_t first, std::int32_t second)
  {
    return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(second);
  }
};

/** Marks the cells of a run that equal an earlier one. Reorders the cells. */
void MarkRepeated(std::vector<RunCell>& cells, std::uint8_t* marks)
{
  // For so few, comparing each with each is faster than sorting.
  constexpr std::size_t few = 8;
  if (cells.size() <= few)
  {
    for (std::size_t i = 1; i < cells.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        marks[i] = marks[i] | cells[i].HasVerticesOf(cells[j]);
      }
    }
    return;
  }
  std::sort(cells.begin(), cells.end());
  for (std::size_t i = 1; i < cells.size(); ++i)
  {
    marks[cells[i].Place] = cells[i].HasVerticesOf(cells[i - 1]);
  }
}

}

//------------------------------------------------------------------------------
std::vector<std::int32_t> FindLowestCoincident(std::size_t count,
  const std::function<glm::dvec3(std::size_t)>& getPosition, const RangeLoop& loop)
{
  std::vector<MortonKey> keys(count);
  ForEachInBlocks(
    count, loop, [&](std::size_t v) { keys[v] = MakeMortonKey(HashOf(getPosition(v)), v); });
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
std::vector<std::uint8_t> MarkDuplicateCells(const std::vector<MortonKey>& keys,
  const std::function<Quad(std::size_t)>& verticesAt, const RangeLoop& loop)
{
  std::vector<std::uint8_t> marks(keys.size());
  const auto continues = [&keys](std::size_t i)
  { return i > 0 && i < keys.size() && CodeOf(keys[i]) == CodeOf(keys[i - 1]); };
  ForEachBlock(keys.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      std::vector<RunCell> cells;
      // A run belongs to the block in which it begins.
      std::size_t i = first;
      while (i < last && continues(i))
      {
        ++i;
      }
      while (i < last)
      {
        const std::size_t begin = i++;
        if (continues(i))
        {
          cells.clear();
          cells.emplace_back(verticesAt(begin), 0);
          for (; continues(i); ++i)
          {
            cells.emplace_back(verticesAt(i), i - begin);
          }
          MarkRepeated(cells, marks.data() + begin);
        }
      }
    });
  return marks;
}

}
