// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/MortonOrder.h"

#include <algorithm>

namespace meniscus
{
namespace
{

constexpr int BitsPerAxis = 10;
constexpr double CellsPerAxis = 1 << BitsPerAxis;
constexpr int RadixBits = 10;
constexpr std::size_t RadixSize = std::size_t{ 1 } << RadixBits;
/** Number of keys per histogram; many times RadixSize, so that the histograms are cheap. */
constexpr std::size_t Chunk = 32768;

/** Spreads the 10 low bits so that two zeros follow each. */
std::uint32_t SpreadBits(std::uint32_t v)
{
  v = (v | (v << 16)) & 0x030000FFu;
  v = (v | (v << 8)) & 0x0300F00Fu;
  v = (v | (v << 4)) & 0x030C30C3u;
  return (v | (v << 2)) & 0x09249249u;
}

std::size_t Digit(MortonKey key, int shift)
{
  return (key >> shift) & (RadixSize - 1);
}

/** One stable counting pass over the digit at `shift`. */
void RadixPass(const std::vector<MortonKey>& from, int shift, const RangeLoop& loop,
  std::vector<std::size_t>& starts, std::vector<MortonKey>& to)
{
  const std::size_t chunks = (from.size() + Chunk - 1) / Chunk;
  starts.assign(chunks * RadixSize, 0);
  const auto forEachKey = [&](std::size_t first, std::size_t last, auto&& body)
  {
    for (std::size_t chunk = first; chunk < last; ++chunk)
    {
      std::size_t* const ofChunk = starts.data() + chunk * RadixSize;
      const std::size_t end = std::min(from.size(), (chunk + 1) * Chunk);
      for (std::size_t i = chunk * Chunk; i < end; ++i)
      {
        body(ofChunk[Digit(from[i], shift)], from[i]);
      }
    }
  };
  loop(chunks,
    [&](std::size_t first, std::size_t last)
    { forEachKey(first, last, [](std::size_t& count, MortonKey) { ++count; }); });
  std::size_t next = 0;
  for (std::size_t digit = 0; digit < RadixSize; ++digit)
  {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk)
    {
      const std::size_t count = starts[chunk * RadixSize + digit];
      starts[chunk * RadixSize + digit] = next;
      next += count;
    }
  }
  loop(chunks,
    [&](std::size_t first, std::size_t last)
    { forEachKey(first, last, [&to](std::size_t& at, MortonKey key) { to[at++] = key; }); });
}

}

//------------------------------------------------------------------------------
MortonCurve::MortonCurve(const glm::dvec3& lower, const glm::dvec3& upper)
  : Lower(lower)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double extent = upper[axis] - lower[axis];
    this->Scale[axis] = extent > 0.0 ? CellsPerAxis / extent : 0.0;
  }
}

//------------------------------------------------------------------------------
std::uint32_t MortonCurve::Code(const glm::dvec3& position) const
{
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double cell = (position[axis] - this->Lower[axis]) * this->Scale[axis];
    // NaN, from boxes whose length or scale is beyond the range of double, becomes 0.
    const double clamped = std::min(std::max(0.0, cell), CellsPerAxis - 1.0);
    code |= SpreadBits(static_cast<std::uint32_t>(clamped)) << axis;
  }
  return code;
}

//------------------------------------------------------------------------------
std::uint32_t MortonCode(const std::int64_t position[3], int bits)
{
  constexpr std::int64_t lastCell = (1 << BitsPerAxis) - 1;
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t fromLower = position[axis] + (std::int64_t{ 1 } << (bits - 1));
    const std::int64_t cell = std::min(fromLower >> (bits - BitsPerAxis), lastCell);
    code |= SpreadBits(static_cast<std::uint32_t>(cell)) << axis;
  }
  return code;
}

//------------------------------------------------------------------------------
void SortByCode(std::vector<MortonKey>& keys, const RangeLoop& loop)
{
  std::vector<MortonKey> scratch(keys.size());
  std::vector<std::size_t> starts;
  for (int shift = 32; shift < 62; shift += RadixBits)
  {
    RadixPass(keys, shift, loop, starts, scratch);
    keys.swap(scratch);
  }
}

}
