// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Error of virtual vertices, as the thesis measures it (section 4.1): the algorithm maps a point to
 * its virtual vertex; the sight ray of that vertex is traced through the exact surfaces, and
 * Eq. 2.4 is inverted on the exact refracted ray. The error is the distance between the resulting
 * point and the original one.
 */
#pragma once

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Refraction/Stack/StackSightRay.h"
#include "Refraction/Stack/StackSolver.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace meniscus
{

/** Outcome of one sample. */
enum class SampleState : unsigned char
{
  Measured = 0,
  NoImage = 1,       ///< the algorithm finds no image
  SeveralImages = 2, ///< the point lies in a zone of convergence, or on the wall between two cells
  NoExactPoint = 3,  ///< the sight ray misses the exact surface or is totally reflected there
  NotFinite = 4      ///< the coordinates of the sample are out of range
};

struct ErrorSample
{
  double Error = 0.0; ///< length in world units; meaningful for measured samples only
  SampleState State = SampleState::NoImage;
  /** Angle at the eye in radians, see FindAngularError; NaN if it is not measured. */
  double Angle = std::numeric_limits<double>::quiet_NaN();
};

struct ErrorSummary
{
  double Mean = 0.0;
  double Deviation = 0.0; ///< standard deviation of the measured samples themselves, not an
                          ///< estimate for a larger population
  double Largest = 0.0;
  std::size_t Count = 0; ///< number of measured samples
};

/** Exact ray behind the last surface: a place that it passes and its unit direction. */
struct ExactRay
{
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
};

/** Traces the exact sight ray along a unit vector. Returns false if nothing is refracted there. */
using ExactTrace = std::function<bool(const glm::dvec3& direction, ExactRay& ray)>;

/**
 * Angle at the eye between the unit vector `seen`, along which `point` is drawn, and the sight ray
 * that really shows the point, found by Newton's method from there; NaN if it finds none.
 */
double FindAngularError(const glm::dvec3& seen, const glm::dvec3& point, const ExactTrace& trace);

/** Measures errors of virtual vertices. World coordinates. */
class ErrorSampler
{
public:
  /**
   * `eye` and `links` of the solvers under test, and `exact` surfaces of the links. `links` and
   * `exact` must outlive this object. Angles are measured if `angles` is set.
   */
  ErrorSampler(const glm::dvec3& eye, const std::vector<RefractionStack::Link>& links,
    const StackSurfaces& exact, bool angles = false)
    : Eye(eye)
    , Links(links)
    , Exact(exact)
    , Angles(angles)
  {
  }

  /** Error with the thesis's cells. Only points in exactly one cell are measured. */
  ErrorSample Measure(const FlatMembraneSolver& solver, const glm::dvec3& point) const;

  /** Error with curved patches. Only points with exactly one image are measured. */
  ErrorSample Measure(const CurvedMembraneSolver& solver, const glm::dvec3& point) const;

  /** The same for several interfaces. The image must be behind at least one of them. */
  ErrorSample Measure(const StackSolver& solver, const glm::dvec3& point) const;

private:
  ErrorSample Compare(const glm::dvec3& point, const glm::dvec3& seen,
    const std::vector<glm::dvec3>& sightPoints) const;
  bool Trace(const std::vector<glm::dvec3>& sightPoints, const glm::dvec3& direction,
    ExactRay& behind, glm::dvec3& first, double& between) const;

  glm::dvec3 Eye;
  const std::vector<RefractionStack::Link>& Links;
  const StackSurfaces& Exact;
  bool Angles;
};

/**
 * Statistics in the order of the samples, in two passes, so that nothing cancels and the result
 * does not depend on the number of threads.
 */
ErrorSummary Summarize(const ErrorSample* samples, std::size_t count);

}
