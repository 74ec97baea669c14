// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Curved_SightRaySearch_h
#define meniscus_Refraction_Curved_SightRaySearch_h

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Intersections of sight rays with all patches of a membrane that the rays meet from the front. A
 * tree over the cones in which the eye sees the patches finds the candidates, and PatchCrossings
 * solves them, so that no starting point is needed. Newton's method from a nearby place
 * (CurvedMembraneSolver::MeetRay) is faster, but may diverge where the ray is nearly tangential.
 */
class SightRaySearch
{
public:
  /** `geometry` must be ready to solve, and must outlive this object. */
  explicit SightRaySearch(const CurvedMembraneSolver& geometry);

  /**
   * Intersection of the ray from the eye along the unit vector `direction` nearest to the place
   * `near`, in world coordinates, with the unit normal. Returns false if there is none. Places
   * where the ray touches the membrane within rounding are not counted.
   */
  bool Find(const glm::dvec3& direction, const glm::dvec3& near, PatchPoint& at) const
  {
    std::int32_t facet = CurvedPatches::NoFacet;
    return this->Find(direction, near, at, facet);
  }
  /** Also sets the facet that the intersection lies in. */
  bool Find(
    const glm::dvec3& direction, const glm::dvec3& near, PatchPoint& at, std::int32_t& found) const;

private:
  const CurvedMembraneSolver& Geometry;
  RayTubeTree Tree;
  double Distance;            ///< of the places along sight rays that the tree is asked for
  double Slack;               ///< rounding of positions
  std::vector<double> Bulges; ///< of the patches
};

}

#endif
