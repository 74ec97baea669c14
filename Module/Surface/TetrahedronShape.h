// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

/** Six times the volume of a tetrahedron; positive in VTK's order of corners. */
inline double SixfoldVolume(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
  return glm::dot(b - a, glm::cross(c - a, d - a));
}

/**
 * Whether rounding decides on the sign of a tetrahedron's volume. Three differences, nine products
 * of two and three of three numbers with their sums have relative errors of at most 8 epsilon of
 * the product of the edges' lengths.
 */
inline bool IsFlat(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
  constexpr double roundingBound = 8.0 * std::numeric_limits<double>::epsilon();
  return !(std::abs(SixfoldVolume(a, b, c, d)) >
    roundingBound * glm::length(b - a) * glm::length(c - a) * glm::length(d - a));
}

/**
 * Radius of the sphere through the corners over the length of the shortest edge: sqrt(6) / 4 for a
 * regular tetrahedron, infinite for a flat one.
 */
inline double RadiusEdgeRatio(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
  const glm::dvec3 u = b - a;
  const glm::dvec3 v = c - a;
  const glm::dvec3 w = d - a;
  const double sixfold = std::abs(glm::dot(u, glm::cross(v, w)));
  const glm::dvec3 center = glm::dot(u, u) * glm::cross(v, w) + glm::dot(v, v) * glm::cross(w, u) +
    glm::dot(w, w) * glm::cross(u, v);
  const double shortest = std::min({ glm::length(u), glm::length(v), glm::length(w),
    glm::length(v - u), glm::length(w - u), glm::length(w - v) });
  const double scale = 2.0 * sixfold * shortest;
  return scale > 0.0 ? glm::length(center) / scale : std::numeric_limits<double>::infinity();
}

} // namespace meniscus
