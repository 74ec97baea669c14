// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shooting at a point through a stack: Newton's method for the place in the first surface whose ray
 * meets the point behind the first `count` interfaces.
 */
#pragma once

#include "Refraction/Stack/RefractionStack.h"

#include <cstddef>

namespace meniscus
{

/** A point to shoot at, relative to the stack's origin, and the number of interfaces before it. */
struct StackTarget
{
  glm::dvec3 Point;
  std::size_t Count;
};

/**
 * Change of the parameters of a ray, to first order, with which it passes at `shift` from its point
 * `at`. Not finite where the rays are focused.
 */
glm::dvec2 GetMove(const RayJet& ray, const glm::dvec3& at, const glm::dvec3& shift);

/** Point of the ray's line that is nearest to `point`. */
glm::dvec3 GetNearest(const RayJet& ray, const glm::dvec3& point);

/**
 * Largest number of patches of a later surface, among the first `count`, that a ray passes over
 * while its place crosses the first patch, to first order.
 */
double GetFootprint(const StackPath& path, std::size_t count);

/** Footprint of a part of a patch up to which six rays tell the shape of its beam. */
constexpr double LargestFootprint = 4.0;

/**
 * Moves a place in the first surface, across edges to other patches. Returns false if it leaves the
 * surface. The next patch takes over where the place leaves its facet by more than `reach`.
 */
constexpr double FollowReach = 0.3;
bool Advance(const RefractionStack& stack, const glm::dvec2& move, StackPlace& place,
  double reach = FollowReach);

/** End of Newton's method for a target. */
enum class ShotEnd
{
  Converged,
  /**
   * The steps lead beyond the border of the first surface, or to rays that do not pass. Where rays
   * are nearly linear, the only root is there, and it is no image.
   */
  Outside,
  Failed
};

/** Steps of Newton's method that suffice from a place near the root of a nearly linear map. */
constexpr int ShotSteps = 16;

/**
 * Newton's method from `place` with at most `steps` steps. Crossings with later surfaces are
 * looked for near the crossings of the path. If it converges in the surface, the path ends at the
 * target.
 * It need not be an image: see IsImage.
 */
ShotEnd Shoot(const RefractionStack& stack, const StackTarget& target, StackPlace place, int steps,
  StackPath& path);

/**
 * As Shoot, from a place and a path that are close to the target's. The crossings with later
 * surfaces converge together with the place, one step at a time, so that each patch is evaluated
 * once per step.
 */
ShotEnd ShootNear(const RefractionStack& stack, const StackTarget& target, StackPlace place,
  int steps, StackPath& path, std::vector<HeldPatch>& held);

/**
 * True if the last ray of a path, which leads to the target, meets the next interface behind it, or
 * if there is none.
 */
bool GoesOn(const RefractionStack& stack, const StackTarget& target, const StackPath& path);

/**
 * True if a path that Shoot found is physical: each leg goes on to its nearest crossing, and the
 * last one reaches the target, before the next interface, if there is one, which it meets.
 */
bool IsImage(const RefractionStack& stack, const StackTarget& target, const StackPath& path);

/** True if the straight ray from the eye reaches the point before it meets the first interface. */
bool IsBeforeAll(const RefractionStack& stack, const glm::dvec3& point);

}
