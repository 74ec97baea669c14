// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Primitives with a side that runs along a surface, in a cell of rays through the surface. */
#pragma once

#include "Refraction/Images/ObjectPrimitive.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus
{

/** Place of a primitive that touches a surface, within a cell of rays through the surface. */
enum class SurfaceTie
{
  None,   ///< the surface does not pass along the primitive or one of its sides: it clips
  Behind, ///< the part of the primitive in the cell is behind the surface, or in it
  InFront ///< the part of the primitive in the cell is in front of the surface
};

/**
 * Tie of a primitive with a surface. Where a side of the primitive runs along the surface, as the
 * foot of a wall on a pane does, the surface and the side are the same constraint, of which only
 * the side's may clip: interpolated in the cell, the two differ, and they have no intersection that
 * could be computed. A primitive in the surface is behind it.
 * @param corners   the surface at the corners of the cell
 * @param behind    distances of the primitive behind these corners along their rays, times the
 *                  cosine with the primitive
 * @param side      values of the primitive's constraints 1 to 3 at the corners
 * @param slack     rounding of a position on the surface
 */
SurfaceTie FindSurfaceTie(const ObjectPrimitive& primitive,
  const std::array<glm::dvec3, 3>& corners, const glm::dvec3& behind,
  const std::array<glm::dvec3, 3>& side, double slack);

/**
 * Resolves the tie of a primitive with the surface at one end of a leg. `constraint` is the number
 * of the surface's constraint: 0 at the beginning of the leg, PrimitiveConstraints at its end. The
 * surface gets the value 0, which clips nothing, at the cell's corners `whole`. Returns false if
 * the leg does not show the primitive in the cell.
 */
template <typename Corner>
bool ResolveSurfaceTie(const ObjectPrimitive& primitive, const std::array<glm::dvec3, 3>& corners,
  int constraint, double slack, std::vector<Corner>& whole)
{
  const bool isEnd = constraint == PrimitiveConstraints;
  glm::dvec3 behind;
  std::array<glm::dvec3, 3> side;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto at = static_cast<glm::length_t>(i);
    behind[at] = isEnd ? -whole[i].Value[constraint] : whole[i].Value[constraint];
    for (std::size_t k = 0; k < 3; ++k)
    {
      side[k][at] = whole[i].Value[k + 1];
    }
  }
  const SurfaceTie tie = FindSurfaceTie(primitive, corners, behind, side, slack);
  for (std::size_t i = 0; i < 3 && tie != SurfaceTie::None; ++i)
  {
    whole[i].Value[constraint] = 0.0;
  }
  return tie != (isEnd ? SurfaceTie::Behind : SurfaceTie::InFront);
}

/** Length of the longest side of a triangle. */
double GetLongestSide(const std::array<glm::dvec3, 3>& corners);

/**
 * True if a line leaves a plane parallel to a triangle, over the length of the triangle's longest
 * side, by `most` or less. `normal` is set to the unit normal of the triangle.
 */
bool RunsAlong(const glm::dvec3& direction, const std::array<glm::dvec3, 3>& corners, double most,
  glm::dvec3& normal);

}
