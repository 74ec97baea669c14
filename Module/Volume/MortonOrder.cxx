// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/MortonOrder.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace meniscus
{
namespace
{

constexpr int BitsPerAxis = 10;
constexpr double CellsPerAxis = 1 << BitsPerAxis;
constexpr int RadixBits = 15;
constexpr std::uint32_t RadixSize = 1u << RadixBits;

/** Spreads the 10 low bits so that two zeros follow each. */
std::uint32_t SpreadBits(std::uint32_t v)
{
  v = (v | (v << 16)) & 0x030000FFu;
  v = (v | (v << 8)) & 0x0300F00Fu;
  v = (v | (v << 4)) & 0x030C30C3u;
  return (v | (v << 2)) & 0x09249249u;
}

/** One stable counting pass on the digit at `shift`. */
void RadixPass(const std::vector<std::uint32_t>& codes, int shift,
  const std::vector<std::int64_t>& from, std::vector<std::int64_t>& to)
{
  std::vector<std::int64_t> first(RadixSize + 1, 0);
  for (const std::uint32_t code : codes)
  {
    ++first[((code >> shift) & (RadixSize - 1)) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (const std::int64_t index : from)
  {
    to[first[(codes[index] >> shift) & (RadixSize - 1)]++] = index;
  }
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
    const double clamped = std::min(std::max(cell, 0.0), CellsPerAxis - 1.0);
    code |= SpreadBits(static_cast<std::uint32_t>(clamped)) << axis;
  }
  return code;
}

//------------------------------------------------------------------------------
std::vector<std::int64_t> SortedOrder(const std::vector<std::uint32_t>& codes)
{
  std::vector<std::int64_t> order(codes.size());
  std::vector<std::int64_t> scratch(codes.size());
  std::iota(order.begin(), order.end(), std::int64_t{ 0 });
  RadixPass(codes, 0, order, scratch);
  RadixPass(codes, RadixBits, scratch, order);
  return order;
}

}
