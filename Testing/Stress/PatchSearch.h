// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"

namespace meniscus::test
{

/**
 * Sight points on the patches of a membrane by a dense search: every facet is sampled, and Newton's
 * method with finite differences is started wherever the samples do not exclude a root. Of the
 * kernel only the patches are used. Some roots may be missed; those found are roots.
 */
class PatchSearch
{
public:
  /** All positions are relative to the membrane's origin. */
  PatchSearch(const CurvedPatches& patches, std::size_t facets, const glm::dvec3& eye,
    double exterior, double interior)
    : Patches(patches)
    , Facets(facets)
    , Eye(eye)
    , Exterior(exterior)
    , Interior(interior)
  {
  }

  struct Sight
  {
    glm::dvec3 Place;
    /**
     * Determinant of the equation's derivative over the product of its columns' lengths: near 0 at
     * a caustic.
     */
    double Condition;
    /** Smallest barycentric coordinate, and cosines towards the eye and away from the point. */
    double Inside;
    double Facing;
    std::int32_t Facet;
  };
  std::vector<Sight> Find(const glm::dvec3& point) const;

  /** Residual of Snell's law at a place: the sine of the angle between h and the normal. */
  double Residual(const glm::dvec3& point, const glm::dvec3& place, std::int32_t facet) const;

private:
  glm::dvec2 GetEquation(
    const CurvedPatch& patch, const glm::dvec3& point, const glm::dvec2& b) const;
  bool Solve(
    const CurvedPatch& patch, const glm::dvec3& point, glm::dvec2& b, double& condition) const;
  void SearchImages(std::int32_t facet, const glm::dvec3& point, std::vector<Sight>& found) const;
  glm::dvec3 Misfit(const PatchPoint& at, const glm::dvec3& point) const;

  const CurvedPatches& Patches;
  std::size_t Facets;
  glm::dvec3 Eye;
  double Exterior;
  double Interior;
};

} // namespace meniscus::test
