// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Places on rays at which something is seen, in double precision, on the segments of
 * ReferenceRayIntegrator: the truth for picks and for images of events. Thresholds and peaks are
 * found by bisection, not by the kernel's formulas.
 */
#pragma once

#include "MathBasics.h"
#include "ReferenceOptics.h"

namespace meniscus::test
{

/** A place on a ray. */
struct TrueEvent
{
  /** Distance from the origin of the ray in world units. */
  double Distance = 0.0;
  /** Negative if there is no such place. */
  std::int64_t Cell = -1;
  double Scalar = 0.0;
  int Surface = -1;

  bool IsFound() const { return this->Cell >= 0; }
};

/** First visible place, place of the opacity, place of the largest contribution. */
using TrueEvents = std::array<TrueEvent, 3>;

TrueEvents EventsOfMedium(const reference::Ray& ray,
  const std::vector<reference::RaySegment>& segments,
  const reference::ReferenceTransferFunction& function, double opacity);

/** @param surfaces in the order of the property's list. */
TrueEvents EventsOfSurfaces(const reference::Ray& ray,
  const std::vector<reference::RaySegment>& segments,
  const std::vector<reference::Surface>& surfaces, double opacity);

/** All three places are the first one of the extreme. */
TrueEvents EventsOfExtreme(
  const reference::Ray& ray, const std::vector<reference::RaySegment>& segments, bool isMaximum);

/** The events of a ray's segments. */
using FindEvents =
  std::function<TrueEvents(const reference::Ray&, const std::vector<reference::RaySegment>&)>;

/** Truth of a ray, and its change by the rounding of its input. */
struct RobustEvents
{
  TrueEvents Events;
  /** Largest change of each distance, infinite if the event vanishes. */
  std::array<double, 3> Change{};
  /** True if the event stays in its cell. */
  std::array<bool, 3> StaysInCell{};
};

/**
 * The events of a ray, and of its neighbours: moved sideways in 8 directions by the rounding of a
 * ray in the kernel, and with all scalars shifted up or down by the rounding of normalised scalars.
 *
 * Rounding of a ray, in units of the radius of the mesh: FixedPointRays::RoundingOfRay, 257 grid
 * units of 2^-30 (1 + steepest slope), is a bound of 2.4e-7 (1 + slope); `slope` is the tangent of
 * half the view angle. Rounding of scalars: floats in [-1, 1] are rounded by 2^-25 of half the
 * range, and interpolated with the same error at three corners: 2^-24 of the range, `scalarRange`.
 * An event within `depthRounding` of the neighbour along the ray may as well be in that cell.
 */
RobustEvents FindRobustEvents(const reference::ReferenceRayIntegrator& integrator,
  const reference::Ray& ray, const FindEvents& find, double slope, double scalarRange,
  double depthRounding);

} // namespace meniscus::test
