// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Sides of primitives that meet a surface, or run along it, in a cell of the sheet. */
#ifndef meniscus_Refraction_StackImages_SurfaceTie_h
#define meniscus_Refraction_StackImages_SurfaceTie_h

#include "Refraction/Images/ObjectPrimitive.h"
#include "Refraction/StackImages/SightSheet.h"

#include <glm/vec3.hpp>

#include <array>

namespace meniscus
{

/** Place of a primitive that touches the surface at an end of a leg, within a cell of the sheet. */
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

/** Points of the surface at the beginning or the end of a leg, at the corners of a cell. */
std::array<glm::dvec3, 3> GetSurfaceCorners(const LegCell& cell, bool isEnd);

/**
 * Moves a place on a side, its parameter `l`, to the nearest crossing of the side with a surface.
 * The place stays where it is if the side leaves the surface, over the length of the cell, by less
 * than linear interpolation in the cell leaves the rays: then the cell does not determine where the
 * two cross, and may have a crossing where they have none.
 * @param corners  the surface at the corners of the cell
 * @param error    error of linear interpolation in the cell, over the length of the cell
 * @return false if there is no crossing within the length of the cell
 */
bool MoveToSurface(const RefractionStack::Link& link, const ObjectLine& side,
  const std::array<glm::dvec3, 3>& corners, double error, double& l);

/** Length of the longest side of a triangle. */
double GetLongestSide(const std::array<glm::dvec3, 3>& corners);

}

#endif
