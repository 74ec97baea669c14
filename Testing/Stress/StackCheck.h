// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Sight/VirtualVertex.h"
#include "RefractionCheck.h"
#include "StackCase.h"

namespace meniscus::test
{

/** Runs a loop in seven ranges on two threads, the last ranges first. */
void ReversedThreadsLoop(std::size_t count, const RangeBody& body);

/** The side of the scenes before they are scaled. */
constexpr double Side = 200.0;

/** Part of a facet within which two images, or two crossings of a ray, are the same. */
constexpr double SamePlace = 1e-5;

/** Part of a facet by which a sight point may be off; Newton's method leaves less than 1e-10. */
constexpr double Rest = 1e-8;

/** Distance from a border, in facets, within which rounding decides. */
constexpr double AtBorder = 1e-6;

/**
 * Cosines, roots of the radicand in Snell's law, and conditions of the map from the first surface
 * to the point: a value closer to zero is left open, because rounding or the merging of close
 * images decides there.
 */
constexpr double Marginal = 1e-3;

/** Points of a case that lie on traced rays, or anywhere. */
constexpr int PointsPerCase = 24;

/** Scales a mesh about the origin, and moves it. */
reference::MembraneMesh PlaceMesh(
  reference::MembraneMesh mesh, double scale, const glm::dvec3& offset);

/** Rounding of a position in a scene of that scale, seen from an eye before the scaling. */
double RoundingOf(double scale, const glm::dvec3& offset, const glm::dvec3& eye);

/** Coordinates of a number of points on the way along some others. */
std::vector<double> PointsAlong(const std::vector<glm::dvec3>& points, std::size_t count);

/** True if two virtual vertices have the same bits, except for padding. */
bool IsSame(const VirtualVertex& a, const VirtualVertex& b);

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

/** Images of a point by both searches of a solver: all images, and the first one. */
template <typename Solver, typename Image, typename Vertex>
struct BothSearches
{
  std::vector<Image> All;
  typename Solver::Memory Memory; ///< of the search for the first image
  Vertex First;
  bool IsDecided; ///< the solver is sure that these are all images

  /** Solves a point in world coordinates. Returns false if there is no answer. */
  bool Run(const Solver& solver, const glm::dvec3& world, RefractionTally& tally)
  {
    ++tally.Points;
    const std::int64_t undecided = solver.GetNumberOfUndecidedSearches();
    const ImageState state = solver.FindImages(world, this->All);
    this->IsDecided = solver.GetNumberOfUndecidedSearches() == undecided;
    tally.Undecided += !this->IsDecided;
    this->First = solver.SolvePoint(world, this->Memory);
    return state != ImageState::NotFinite && this->First.State != ImageState::NotFinite;
  }
};

/**
 * Solves points behind a list of interfaces and compares every answer with Snell's law, with rays
 * that were traced through every patch, with the way back, and with the same list on two threads
 * and with interfaces of equal indices.
 */
RefractionTally CheckStack(const StackCase& test);

/** The same for a mirror and the law of reflection. */
RefractionTally CheckMirror(const MirrorCase& test);

} // namespace meniscus::test
