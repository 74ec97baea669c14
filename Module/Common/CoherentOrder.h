// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Order in which each of `count` points (x, y, z each) is near the previous point, for solvers that
 * start from the previous answer. Empty if the given order is such an order, or has 2^32 points and
 * more; otherwise the points' indices along a Hilbert curve, points that are not finite first.
 *
 * An order is coherent if its mean step is at most twice the diagonal of the points' bounding box
 * over the cube root of their number. Rows of points that fill a box have less: one distance of
 * neighbours from each point to the next, and one jump back through the box per row, which adds
 * another distance per point.
 */
std::vector<std::uint32_t> FindCoherentOrder(
  const double* points, std::size_t count, const RangeLoop& loop = SerialLoop);

/**
 * Calls `solve(points, begin, end, answers)` for blocks of points with the indices order[begin] to
 * order[end - 1], `Block` of them at a time, and writes answers to the points' places in `answers`.
 * With an empty order, the given one, it is called once, without copies.
 */
template <std::size_t Block, typename Answer, typename Solve>
void SolveInOrder(const double* points, const std::vector<std::uint32_t>& order, std::size_t begin,
  std::size_t end, Answer* answers, const Solve& solve)
{
  if (order.empty())
  {
    solve(points, begin, end, answers);
    return;
  }
  std::array<double, 3 * Block> ordered;
  std::vector<Answer> solved(Block);
  for (std::size_t first = begin; first < end; first += Block)
  {
    const std::size_t size = std::min(Block, end - first);
    for (std::size_t i = 0; i < size; ++i)
    {
      std::copy_n(points + 3 * std::size_t{ order[first + i] }, 3, ordered.begin() + 3 * i);
    }
    solve(ordered.data(), std::size_t{ 0 }, size, solved.data());
    for (std::size_t i = 0; i < size; ++i)
    {
      answers[order[first + i]] = solved[i];
    }
  }
}

}
