// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Sides of primitives that meet a surface of a list in a cell of the sheet. */
#pragma once

#include "Refraction/Images/SurfaceTie.h"
#include "Refraction/StackImages/SightSheet.h"

#include <glm/vec3.hpp>

#include <array>

namespace meniscus
{

/** Points of the surface at the beginning or the end of a leg, at the corners of a cell. */
std::array<glm::dvec3, 3> GetSurfaceCorners(const LegCell& cell, bool isEnd);

/**
 * Moves a place on a side, its parameter `l`, to the nearest crossing of the side with a surface.
 * The place stays where it is if the side stays closer to the surface, over one length of the cell,
 * than the error of linear interpolation there: then the cell does not determine where the two
 * cross, and may have a crossing where they have none.
 * @param corners  the surface at the corners of the cell
 * @param error    error of linear interpolation in the cell, over the length of the cell
 * @return false if there is no crossing within the length of the cell
 */
bool MoveToSurface(const RefractionStack::Link& link, const ObjectLine& side,
  const std::array<glm::dvec3, 3>& corners, double error, double& l);

}
