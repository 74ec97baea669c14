// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "RefractionCheck.h"
#include "StackCase.h"

namespace meniscus::test
{

/** Runs a loop in seven ranges on two threads, the last ranges first. */
void ReversedThreadsLoop(std::size_t count, const RangeBody& body);

/** The side of the scenes before they are scaled. */
constexpr double Side = 200.0;

/** Scales a mesh about the origin, and moves it. */
reference::MembraneMesh PlaceMesh(
  reference::MembraneMesh mesh, double scale, const glm::dvec3& offset);

/** Rounding of a position in a scene of that scale, seen from an eye before the scaling. */
double RoundingOf(double scale, const glm::dvec3& offset, const glm::dvec3& eye);

/** Coordinates of a number of points on the way along some others. */
std::vector<double> PointsAlong(const std::vector<glm::dvec3>& points, std::size_t count);

/** A place anywhere in a facet. */
glm::dvec2 RandomPlace(StressRandom& random);

/** A ray that leaves the first surface beside another one. */
struct NearRay
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;
};

/**
 * Determinant of the map from the first facet to the plane through the point and across `axis`,
 * over the square of its longer column, by differences: 0 on a caustic or if rays beside this one
 * do not pass, for which `rayAt` returns nothing.
 * @param b the ray's place in the first facet.
 */
double MeasureCondition(const glm::dvec2& b, const glm::dvec3& point, const glm::dvec3& axis,
  const std::function<std::optional<NearRay>(const glm::dvec2&)>& rayAt);

/**
 * Solves points behind a list of interfaces and compares every answer with Snell's law, with rays
 * that were traced through every patch, with the way back, and with the same list on two threads
 * and with interfaces of equal indices.
 */
RefractionTally CheckStack(const StackCase& test);

/** The same for a mirror and the law of reflection. */
RefractionTally CheckMirror(const MirrorCase& test);

} // namespace meniscus::test
