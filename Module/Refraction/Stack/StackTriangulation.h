// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Stack/StackSightRay.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus
{

/** Outcome of a triangulation. */
enum class TriangulationState : unsigned char
{
  Found = 0,
  TooFewRays = 1, ///< fewer than two rays show anything
  Parallel = 2,   ///< the rays are parallel within rounding
  NoMedium = 3    ///< no medium is reached by all rays
};

/** A point that is seen by several eyes. */
struct TriangulatedPoint
{
  glm::dvec3 Position{ 0.0 };
  double Residual = 0.0; ///< root of the mean square distance of the rays from the position
  double Angle = 0.0;    ///< largest angle between two rays at the position, in radians
  TriangulationState State = TriangulationState::TooFewRays;
};

/**
 * The point with the least sum of squared distances from sight rays of one stack, whose eyes may be
 * on different sides of an interface. The point lies in one medium: for each medium that all rays
 * reach, the point nearest to the lines of the legs there is computed. The result is the point with
 * the least distances from the legs themselves; of two equal points, the point farther along the
 * first ray. Legs are in the same medium if they touch the same side of an interface. A leg that
 * misses the next surface shows nothing.
 */
TriangulatedPoint Triangulate(const std::vector<StackSightRay>& rays);

}
