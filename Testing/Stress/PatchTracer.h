// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"
#include "Refraction/Membrane/CurvedPatches.h"

namespace meniscus::test
{

/** Crossing of a ray with a patch. */
struct PatchHit
{
  std::int32_t Facet;
  glm::dvec2 B;
  double Distance;
  glm::dvec3 Position;
  glm::dvec3 Normal; ///< unit length, on the side that the ray comes from
  /** Smallest barycentric coordinate. */
  double Inside;
};

/**
 * Crossings of rays with the patches of a surface: Newton's method from several places in every
 * patch whose sphere the ray meets. Of the kernel only the evaluation of a patch is used, no tree,
 * no walk and no earlier crossing. All positions are relative to the membrane's origin.
 */
class PatchTracer
{
public:
  PatchTracer(const CurvedPatches& patches, std::size_t facets);

  /**
   * Normals that tell the side from which a ray crosses a patch. Interpolated ones, by which rays
   * are refracted, and those of the patch's shape may tell different sides at grazing incidence.
   */
  enum class Sides
  {
    ByNormals,
    ByShape
  };

  /**
   * All crossings with the ray from `origin` along the unit vector `direction` that go against the
   * normals (`fromFront`), or along them, nearest first. Distances are above `least`.
   */
  std::vector<PatchHit> FindCrossings(const glm::dvec3& origin, const glm::dvec3& direction,
    bool fromFront, double least, Sides sides = Sides::ByNormals) const;

  /**
   * The place of a patch that a position lies on, or one near it. Use this where a ray grazes a
   * patch: its two crossings are so close that FindCrossings() may find one of them only.
   */
  PatchHit FindFoot(std::int32_t facet, const glm::dvec3& position, bool fromFront) const;

  /** Hit at a known place, as if seen from the given side. */
  PatchHit Evaluate(std::int32_t facet, const glm::dvec2& b, bool fromFront) const;

  /** True if a place is on, or within `width` of, an edge without exactly one neighbour. */
  bool IsAtBorder(std::int32_t facet, const glm::dvec2& b, double width) const;

  double GetSize(std::int32_t facet) const { return this->Patches.GetPatch(facet).GetSize(); }
  std::size_t GetNumberOfFacets() const { return this->Spheres.size(); }

private:
  struct Sphere
  {
    glm::dvec3 Centre;
    double Radius;
  };

  const CurvedPatches& Patches;
  std::vector<Sphere> Spheres;
};

} // namespace meniscus::test
