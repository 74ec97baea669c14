// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** A map of second degree from a triangle to the plane, by control points, and its distance from 0.
 */
#pragma once

#include "Refraction/Membrane/CrossProduct.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace meniscus
{

/** Values, or control points, at the corners and then at the middles of the opposite edges. */
using TriangleMap = std::array<glm::dvec2, 6>;

/**
 * True if, for one of the lines along the sides of the linear part, all control points, each a disc
 * of radius `margin`, are on the side away from zero.
 */
inline bool IsSeparated(const TriangleMap& control, double margin)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2 side = control[(k + 2) % 3] - control[(k + 1) % 3];
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const glm::dvec2& point : control)
    {
      const double distance = Cross(side, point);
      low = std::min(low, distance);
      high = std::max(high, distance);
    }
    const double slack = margin * glm::length(side);
    if (low > slack || high < -slack)
    {
      return true;
    }
  }
  return false;
}

/**
 * True if the map with these control points, each a disc of radius `margin`, is injective: the
 * determinants of all pairs of control vectors of its derivatives have one sign. Each column of a
 * determinant has an error of twice the margin.
 */
inline bool IsInjective(const TriangleMap& c, double margin)
{
  // Pairs of determinants that differ more than this are too close to a caustic.
  constexpr double smallest = 0.05;
  const glm::dvec2 first[3] = { c[5] - c[0], c[1] - c[5], c[3] - c[4] };
  const glm::dvec2 second[3] = { c[4] - c[0], c[3] - c[5], c[2] - c[4] };
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  double longest = 0.0;
  for (const glm::dvec2& u : first)
  {
    for (const glm::dvec2& v : second)
    {
      const double determinant = Cross(u, v);
      low = std::min(low, determinant);
      high = std::max(high, determinant);
      longest = std::max(longest, glm::length(u) + glm::length(v));
    }
  }
  const double slack = 2.0 * margin * longest;
  return low - slack > smallest * high || -high - slack > smallest * -low;
}

}
