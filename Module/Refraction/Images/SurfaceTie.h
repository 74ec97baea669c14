// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Primitives with a side that runs along a surface, in a cell of rays through the surface. */
#ifndef meniscus_Refraction_Images_SurfaceTie_h
#define meniscus_Refraction_Images_SurfaceTie_h

#include "Refraction/Images/ObjectPrimitive.h"

#include <glm/vec3.hpp>

#include <array>

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

/** Length of the longest side of a triangle. */
double GetLongestSide(const std::array<glm::dvec3, 3>& corners);

}

#endif
