// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Bounds of the rays that go from a part of the first surface through a stack, by interval
 * arithmetic on Snell's law, surface by surface. No ray is outside of them. Positions are relative
 * to the stack's origin.
 */
#pragma once

#include "Refraction/Stack/RefractionStack.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace meniscus
{

/** True if two boxes have a common point. */
inline bool Overlap(const AxisBox& a, const AxisBox& b)
{
  return a.Low.x <= b.High.x && a.Low.y <= b.High.y && a.Low.z <= b.High.z && b.Low.x <= a.High.x &&
    b.Low.y <= a.High.y && b.Low.z <= a.High.z;
}

/** Corners of a triangle in a patch. */
using PatchTriangle = std::array<glm::dvec2, 3>;

/** Bounds of the rays behind an interface, from bounds of the rays before it. */
TubeBounds BoundNextLeg(const RefractionStack::Link& link, const TubeBounds& before);

/**
 * Bounds of the rays from a triangle in a patch of the first surface behind `count` interfaces, at
 * least one. They are not valid if no ray passes these.
 */
TubeBounds BoundStackRays(const RefractionStack& stack, std::int32_t facet,
  const PatchTriangle& corners, std::size_t count);

/**
 * False if interval arithmetic proves that no ray to the triangle passes the interfaces before
 * `surface`, counted from 0, and meets that one from the right side.
 */
bool MayMeet(const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners,
  std::size_t surface);

/**
 * False if interval arithmetic proves that no ray to the triangle passes `count` interfaces, at
 * least one, and meets the box behind them.
 */
bool MayReach(const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners,
  std::size_t count, const AxisBox& box);

}
