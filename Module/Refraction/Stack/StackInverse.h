// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The way from a virtual point to the true one through several surfaces: the sight ray is traced,
 * and the depth convention of StackSolver is inverted along it. World coordinates.
 */
#pragma once

#include "Refraction/Sight/SeenDepth.h"
#include "Refraction/Stack/StackSightRay.h"

#include <cstddef>

namespace meniscus
{

/** Outcome for a point that is seen. */
enum class SeenState : unsigned char
{
  Unrefracted = 0,      ///< no surface in front of the point, which is where it is seen
  Refracted = 1,        ///< behind a surface
  TotallyReflected = 2, ///< beyond the critical angle nothing is seen through the surface
  NotFinite = 3,        ///< the coordinates are not finite, or equal to the eye's
  Missed = 4            ///< the ray misses a surface behind the first one
};

struct TruePosition
{
  glm::dvec3 Position;
  /** Place where the sight ray meets the first surface; NaN if the point is not refracted. */
  glm::dvec3 SightPoint;
  SeenState State;
  /** Length of the path from the eye to the position, times the indices along it. */
  double OpticalPath;
};

/**
 * True position of a point that is seen through a list of interfaces: the inverse of the virtual
 * vertices (Eq. 2.4). The point may lie behind all interfaces, or between two of them if the ray
 * goes on to the next one. Points without a true position keep theirs. `medium` is the index of
 * refraction around the eye, which a stack without links does not know. `depth` is the meaning of
 * the distance at which the point is seen. See StackPatches for `chain`.
 */
TruePosition FindTruePosition(const RefractionStack& stack, double medium, const glm::dvec3& seen,
  StackChain* chain = nullptr, SeenDepth depth = SeenDepth::Apparent);

/** The same for a point that is seen from its own eye. */
TruePosition FindTruePosition(SightRayTracer& tracer, const glm::dvec3& eye, const glm::dvec3& seen,
  StackChain* chain = nullptr, SeenDepth depth = SeenDepth::Apparent);

/**
 * As FindTruePosition, for a traced ray. `leg` is set to the leg that the position lies on, or to
 * the last leg of a ray that does not show it.
 */
TruePosition WalkSightRay(const StackSightRay& ray, const glm::dvec3& seen, std::size_t& leg,
  SeenDepth depth = SeenDepth::Apparent);

}
