// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meniscus
{

/**
 * Sorts the boxes [first, last) into two halves along the axis in which their centres differ most,
 * and returns the index at which the second half begins. Ties are broken by Item::Index, so that
 * the result is the same on every machine.
 * @param items boxes with the members Lower, Upper and Index.
 * @pre last - first > 1
 */
template <class Item>
std::size_t SplitAtMedian(std::vector<Item>& items, std::size_t first, std::size_t last)
{
  auto lower = items[first].Lower + items[first].Upper;
  auto upper = lower;
  for (std::size_t i = first + 1; i < last; ++i)
  {
    const auto twice = items[i].Lower + items[i].Upper;
    lower = glm::min(lower, twice);
    upper = glm::max(upper, twice);
  }
  const auto extent = upper - lower;
  const int axis =
    extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&items](std::size_t i)
  { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
    [axis](const Item& a, const Item& b)
    {
      const auto centerA = a.Lower[axis] + a.Upper[axis];
      const auto centerB = b.Lower[axis] + b.Upper[axis];
      return centerA != centerB ? centerA < centerB : a.Index < b.Index;
    });
  return middle;
}

}
