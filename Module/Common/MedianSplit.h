// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/common.hpp>

#include <algorithm>

namespace meniscus
{

/**
 * Sorts items into two halves along the axis in which their middles differ most, and returns the
 * beginning of the second half. Ties are broken by `<`, so that the result is the same on every
 * machine.
 * @param middleOf  middle of an item, or a multiple of it
 * @pre end - begin > 1
 */
template <class Iterator, class MiddleOf>
Iterator SplitAtMedian(Iterator begin, Iterator end, const MiddleOf& middleOf)
{
  auto lower = middleOf(*begin);
  auto upper = lower;
  for (Iterator item = begin; item != end; ++item)
  {
    lower = glm::min(lower, middleOf(*item));
    upper = glm::max(upper, middleOf(*item));
  }
  const auto extent = upper - lower;
  const int axis =
    extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const Iterator middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end,
    [axis, &middleOf](const auto& a, const auto& b)
    {
      const auto first = middleOf(a)[axis];
      const auto second = middleOf(b)[axis];
      return first != second ? first < second : a < b;
    });
  return middle;
}

}
