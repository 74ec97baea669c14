// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Stack_StackTriangulation_h
#define meniscus_Refraction_Stack_StackTriangulation_h

#include "Refraction/Stack/StackSightRay.h"

#include <glm/vec3.hpp>

#include <cstddef>
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

/** A sight ray, and the number of refracting interfaces of the list that its eye is behind. */
struct TriangulationRay
{
  StackSightRay Ray;
  std::size_t Passed;
};

/**
 * The point with the least sum of squared distances from sight rays. The point lies in one medium:
 * for each medium that all rays reach, the point nearest to the lines of the legs there is
 * computed; that with the least distances from the legs themselves is the result, the farther one
 * of two that are equal. A leg that misses the next surface shows nothing.
 */
TriangulatedPoint Triangulate(const std::vector<TriangulationRay>& rays);

}

#endif
