// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace meniscus
{

/**
 * Sizes of a facet, and of triangles in it, whose corners are given by their coordinates in the
 * facet. Searches halve slender triangles across their longest side: quarters are as slender as the
 * whole.
 */
class FacetShape
{
public:
  using Corners = std::array<glm::dvec2, 3>;

  FacetShape() = default;
  explicit FacetShape(const CurvedPatch& patch)
    : First(patch.Corner[1] - patch.Corner[0])
    , Second(patch.Corner[2] - patch.Corner[0])
    , Normal(glm::cross(this->First, this->Second))
    , Area(glm::length(this->Normal))
    , Size(patch.GetSize())
    , Slender(this->Size * this->Size > LargestSlenderness * this->Area)
  {
  }

  /** Longest side. */
  double GetSize() const { return this->Size; }
  /** Twice the area. */
  double GetArea() const { return this->Area; }
  /** First side, and normal of the length of GetArea(). */
  const glm::dvec3& GetFirst() const { return this->First; }
  const glm::dvec3& GetNormal() const { return this->Normal; }
  /** False if no triangle that quarters make of the facet is slender. */
  bool IsSlender() const { return this->Slender; }

  /** Longest side of a triangle. */
  double MeasureSize(const Corners& corners) const
  {
    const std::array<double, 3> sides = this->MeasureSides(corners);
    return *std::max_element(sides.begin(), sides.end());
  }

  /** If a triangle is slender, `corner` is the corner opposite to its longest side. */
  bool IsSlender(const Corners& corners, std::size_t& corner) const
  {
    if (!this->Slender)
    {
      return false;
    }
    const std::array<double, 3> sides = this->MeasureSides(corners);
    const auto longest = std::max_element(sides.begin(), sides.end());
    corner = static_cast<std::size_t>(longest - sides.begin());
    const glm::dvec2 u = corners[1] - corners[0];
    const glm::dvec2 v = corners[2] - corners[0];
    const double area = this->Area * std::fabs(u.x * v.y - u.y * v.x);
    return *longest * *longest > LargestSlenderness * area;
  }

private:
  /**
   * Longest side, in units of its height, above which a triangle is slender. As many more quarters
   * would be as wide as their distance from eye or point. Triangles of usual meshes are below.
   */
  static constexpr double LargestSlenderness = 8.0;

  /** Lengths of the sides opposite to the corners. */
  std::array<double, 3> MeasureSides(const Corners& corners) const
  {
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec2 side = corners[(k + 2) % 3] - corners[(k + 1) % 3];
      sides[k] = glm::length(side.x * this->First + side.y * this->Second);
    }
    return sides;
  }

  glm::dvec3 First{ 0.0 };
  glm::dvec3 Second{ 0.0 };
  glm::dvec3 Normal{ 0.0 };
  double Area = 0.0;
  double Size = 0.0;
  bool Slender = false;
};

}
