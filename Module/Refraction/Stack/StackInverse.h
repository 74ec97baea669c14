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
#include "Refraction/Stack/StackSolver.h"

#include <cstddef>

namespace meniscus
{

/** The surfaces that the rays of a stack meet: those of its links, or others close to them. */
class StackSurfaces
{
public:
  virtual ~StackSurfaces() = default;

  /**
   * Intersection of the ray from `origin` along the unit vector `direction` with the surface of a
   * link, from the side from which the link is passed, and the unit normal there, against the ray.
   * @param near  point of the stack's own surface close to the intersection
   * @return false if there is none
   */
  virtual bool Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    const glm::dvec3& near, PatchPoint& at) const = 0;
};

/** The patches of a stack's links. The nearest intersection counts, wherever `near` is. */
class StackPatches : public StackSurfaces
{
public:
  /** `stack` must outlive this object. */
  explicit StackPatches(const RefractionStack& stack)
    : Stack(stack)
  {
  }
  bool Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    const glm::dvec3& near, PatchPoint& at) const override;

private:
  const RefractionStack& Stack;
};

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
 */
StackTruePosition FindTruePosition(
  const RefractionStack& stack, double medium, const glm::dvec3& seen);

/** Error of virtual vertices behind several surfaces; as ErrorSampler for one. */
class StackErrorSampler
{
public:
  /** Solver and exact surfaces must outlive this object. */
  StackErrorSampler(const StackSolver& solver, const StackSurfaces& exact)
    : Solver(solver)
    , Exact(exact)
  {
  }

  /** Only points with exactly one image, behind at least one interface, are measured. */
  ErrorSample Measure(const glm::dvec3& point) const;

private:
  ErrorSample Compare(
    const glm::dvec3& point, const StackVertex& vertex, const StackPath& path) const;

  const StackSolver& Solver;
  const StackSurfaces& Exact;
};

}

#endif
