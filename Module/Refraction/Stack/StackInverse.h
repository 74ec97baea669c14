// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The way from a virtual point to the true one through several surfaces: the sight ray is traced,
 * and the depth convention of StackSolver is inverted along it. World coordinates.
 */
#ifndef meniscus_Refraction_Stack_StackInverse_h
#define meniscus_Refraction_Stack_StackInverse_h

#include "Refraction/Curved/ErrorSamples.h"
#include "Refraction/Curved/TruePositions.h"
#include "Refraction/Stack/StackSightRay.h"
#include "Refraction/Stack/StackSolver.h"

#include <cstddef>

namespace meniscus
{

/** Outcome for a point that is seen through a stack. */
struct StackTruePosition : TruePosition
{
  /** Length of the path from the eye to the position, times the indices along it. */
  double OpticalPath;
};

/**
 * True position of a point that is seen through a stack; as TruePositions for one surface. The
 * point may lie behind all interfaces, or between two of them if the ray goes on to the next one.
 * `medium` is the index of refraction around the eye, which a stack without links does not know.
 * `depth` is the meaning of the distance at which the point is seen. See StackPatches for `chain`.
 */
StackTruePosition FindTruePosition(const RefractionStack& stack, double medium,
  const glm::dvec3& seen, StackChain* chain = nullptr, SeenDepth depth = SeenDepth::Apparent);

/** The same for a point that is seen from its own eye. */
StackTruePosition FindTruePosition(SightRayTracer& tracer, const glm::dvec3& eye,
  const glm::dvec3& seen, StackChain* chain = nullptr, SeenDepth depth = SeenDepth::Apparent);

/**
 * As FindTruePosition, for a traced ray. `leg` is set to the leg that the position lies on, or to
 * the last leg of a ray that does not show it.
 */
StackTruePosition WalkSightRay(const StackSightRay& ray, const glm::dvec3& seen, std::size_t& leg,
  SeenDepth depth = SeenDepth::Apparent);

/** Error of virtual vertices behind several surfaces; as ErrorSampler for one. */
class StackErrorSampler
{
public:
  /** Solver and exact surfaces must outlive this object. `angles` as for ErrorSampler. */
  StackErrorSampler(const StackSolver& solver, const StackSurfaces& exact, bool angles = false)
    : Solver(solver)
    , Exact(exact)
    , Angles(angles)
  {
  }

  /** Only points with exactly one image, behind at least one interface, are measured. */
  ErrorSample Measure(const glm::dvec3& point) const;

private:
  ErrorSample Compare(
    const glm::dvec3& point, const StackVertex& vertex, const StackPath& path) const;
  bool Trace(const StackPath& path, const glm::dvec3& direction, ExactRay& behind,
    glm::dvec3& first, double& between) const;

  const StackSolver& Solver;
  const StackSurfaces& Exact;
  bool Angles;
};

}

#endif
