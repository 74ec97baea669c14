// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Crossing of a line with a triangle.
 *
 * A triangle is crossed if three determinants of the line's direction and two corners have no
 * different signs. Each is computed for one order of the corners, so that the two triangles at an
 * edge decide alike: no line passes between them, and a line through an edge or a corner crosses
 * all triangles at it.
 */
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>

namespace meniscus
{

struct TriangleCrossing
{
  /** Barycentric weights of the corners, in their order; >= 0, with the sum 1. */
  std::array<double, 3> Weights{};
  /** From the line's point to the crossing. */
  glm::dvec3 Way{ 0.0 };
  /** Twice the area of the triangle as seen along the line, for a direction of unit length. */
  double TwiceArea = 0.0;
  /** True if the line goes against the normal, about which the corners turn to the left. */
  bool IsFront = false;
};

/**
 * Returns false if the line does not cross the triangle or lies in its plane.
 * @param corners relative to a point of the line.
 * @param isBefore isBefore(a, b) is true if corner a precedes corner b in an order that all
 *   triangles share.
 */
template <typename Order>
bool CrossTriangle(const std::array<glm::dvec3, 3>& corners, const Order& isBefore,
  const glm::dvec3& direction, TriangleCrossing& crossing)
{
  double edges[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t a = (i + 1) % 3;
    const std::size_t b = (i + 2) % 3;
    edges[i] = isBefore(a, b) ? glm::dot(direction, glm::cross(corners[a], corners[b]))
                              : -glm::dot(direction, glm::cross(corners[b], corners[a]));
  }
  const bool isBack = edges[0] >= 0.0 && edges[1] >= 0.0 && edges[2] >= 0.0;
  crossing.IsFront = edges[0] <= 0.0 && edges[1] <= 0.0 && edges[2] <= 0.0;
  const double sum = edges[0] + edges[1] + edges[2];
  if (!(isBack || crossing.IsFront) || sum == 0.0)
  {
    return false;
  }
  crossing.TwiceArea = std::abs(sum);
  crossing.Way = glm::dvec3(0.0);
  for (std::size_t i = 0; i < 3; ++i)
  {
    crossing.Weights[i] = edges[i] / sum;
    crossing.Way += crossing.Weights[i] * corners[i];
  }
  return true;
}

}
