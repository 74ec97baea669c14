// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/BoundsInFrame.h"
#include "Volume/Refracted/RayLegs.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

/** Box about the mesh, in the form that legs are tested with. The tests have no branches. */
class LegBox
{
public:
  explicit LegBox(const BoundsInFrame& box)
    : Box(box)
  {
    const glm::dmat3& edges = box.HalfEdges;
    const double radius =
      Margin * glm::length(glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]));
    this->SquaredRadius = radius * radius;
    for (int k = 0; k < 3; ++k)
    {
      this->Areas[k] = glm::cross(edges[(k + 1) % 3], edges[(k + 2) % 3]);
      this->Extents[k] = Margin * std::fabs(glm::dot(this->Areas[k], edges[k]));
    }
  }

  /**
   * True if the half-line may meet the box. Tests the box's bounding sphere, and three separating
   * axes, each perpendicular to the line and to an edge of the box.
   */
  bool MayMeet(const RayLeg& line) const
  {
    const glm::dvec3 toCenter = this->Box.Center - line.Begin;
    const double along = glm::dot(toCenter, line.Step);
    const double squared = glm::dot(line.Step, line.Step);
    const double excess = glm::dot(toCenter, toCenter) - this->SquaredRadius;
    bool misses = (excess > 0.0) & !((along > 0.0) & (along * along >= excess * squared));
    const glm::dvec3 across = glm::cross(toCenter, line.Step);
    const double areas[3] = { std::fabs(glm::dot(line.Step, this->Areas[0])),
      std::fabs(glm::dot(line.Step, this->Areas[1])),
      std::fabs(glm::dot(line.Step, this->Areas[2])) };
    for (int k = 0; k < 3; ++k)
    {
      // Along the cross product of step and edge k: the distance of the centre, and the extents of
      // the other two edges.
      const double distance = std::fabs(glm::dot(across, this->Box.HalfEdges[k]));
      const double reach = areas[(k + 1) % 3] + areas[(k + 2) % 3];
      misses |= distance > reach * Margin;
    }
    return !misses;
  }

  /** True if both ends of a leg that ends lie beyond one side of the box. */
  bool IsBeside(const RayLeg& line) const
  {
    const glm::dvec3 toCenter = this->Box.Center - line.Begin;
    const bool ends = line.End < std::numeric_limits<double>::infinity();
    const double length = ends ? line.End - line.Depth : 0.0;
    double gap = -1.0; // positive if both ends lie beyond one side
    for (int k = 0; k < 3; ++k)
    {
      const double begin = -glm::dot(this->Areas[k], toCenter);
      const double end = begin + length * glm::dot(this->Areas[k], line.Step);
      gap = std::max(gap, std::max(std::min(begin, end), -std::max(begin, end)) - this->Extents[k]);
    }
    return ends && gap > 0.0;
  }

private:
  /** Larger than the relative rounding error of vertices by their grid. */
  static constexpr double Margin = 1.0 + 1.0e-6;

  BoundsInFrame Box;
  double SquaredRadius;
  /** Normals of the box's sides, cross products of two edges, and their products with the third. */
  glm::dvec3 Areas[3];
  double Extents[3];
};

}
