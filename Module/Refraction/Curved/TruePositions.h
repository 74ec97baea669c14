// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Curved_TruePositions_h
#define meniscus_Refraction_Curved_TruePositions_h

#include "Refraction/Curved/CrossingChain.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Curved/SightRaySearch.h"
#include "Refraction/Sight/SeenDepth.h"
#include "Refraction/Surface/SteepDirections.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace meniscus
{

/** Outcome for a point that is seen. */
enum class SeenState : unsigned char
{
  Unrefracted = 0,      ///< no membrane in front of the point, which is where it is seen
  Refracted = 1,        ///< behind the membrane
  TotallyReflected = 2, ///< beyond the critical angle nothing is seen through the membrane
  NotFinite = 3,        ///< the coordinates are not finite, or they are those of the eye
  Missed = 4            ///< with several surfaces: the ray misses one of them on the way
};

struct TruePosition
{
  glm::dvec3 Position;
  /** Place where the sight ray meets the membrane; NaN if the point is not refracted. */
  glm::dvec3 SightPoint;
  SeenState State;
};

/**
 * True positions of points that the eye sees through a membrane: the inverse of the virtual
 * vertices (Eq. 2.4). The sight ray to the point is refracted where it meets the membrane first
 * from the front, and the point lies on the refracted ray, at a distance from the sight point that
 * the meaning of its depth gives: n2 / n1 times the distance behind it at which the point is seen,
 * if that is the apparent depth.
 */
class TruePositions
{
public:
  /** `geometry` must be ready to solve; both, of one membrane, must outlive this object. */
  TruePositions(const CurvedMembraneSolver& geometry, const SteepDirections& steep);

  /** Number of points that share a chain of warm starts, as CurvedMembraneSolver::Chain. */
  static constexpr std::size_t Chain = 512;

  /**
   * Finds the true position of a point after the points of `chain`. Neighbouring points need no
   * search; the last bits of the result depend on the points before.
   * @param seen  position in world coordinates. Points without a true position keep it.
   */
  TruePosition Find(
    const glm::dvec3& seen, CrossingChain& chain, SeenDepth depth = SeenDepth::Apparent) const;

private:
  bool Meet(const glm::dvec3& direction, CrossingChain& chain, PatchPoint& at) const;

  const CurvedMembraneSolver& Geometry;
  const SteepDirections& Steep;
  SightRaySearch Search;
  glm::dvec3 Eye;
};

}

#endif
