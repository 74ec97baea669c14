// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>

namespace meniscus
{

/** Cross product in the plane: positive if `b` points to the left of `a`. */
inline double Cross(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/** Twice the signed area of a polygon with the corners placeOf(0) to placeOf(count - 1). */
template <typename PlaceOf>
double GetTwiceArea(std::size_t count, const PlaceOf& placeOf)
{
  double sum = 0.0;
  for (std::size_t i = 2; i < count; ++i)
  {
    sum += Cross(placeOf(i - 1) - placeOf(0), placeOf(i) - placeOf(0));
  }
  return sum;
}

}
