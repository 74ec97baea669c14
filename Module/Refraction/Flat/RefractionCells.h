// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cells of a membrane for one eye (thesis 3.1.1 and 3.1.2). A cell consists of a facet and the
 * refracted rays at its corners. It holds a point if the plane through the point, normal to the
 * mean of the three rays, cuts the rays in a triangle around the point, and if the point lies on
 * the far side of the facet. Each cell uses its own planes, so neighbouring cells may overlap or
 * leave gaps.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Membrane/Optics.h"
#include "Refraction/Sight/EyeStatus.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Number of rays by the equation that they come from, over the vertices that facets use. */
struct RayReport
{
  std::size_t Refracted = 0;
  std::size_t BackFacing = 0;
  std::size_t TotallyReflected = 0;
};

/** Image of a point in a cell. */
struct CellHit
{
  glm::dvec3 Weights; ///< barycentric coordinates of the sight point in the facet
  int Orientation;    ///< +1: the image is upright; -1: it is inverted by a caustic
};

class RefractionCells
{
public:
  /**
   * Computes all rays. `eye` is relative to the membrane's origin; the membrane must outlive this
   * object.
   */
  EyeStatus Update(const Membrane& membrane, const glm::dvec3& eye, double exterior,
    double interior, const RangeLoop& loop);

  /** True if the cell of `facet` holds `point`; borders are included within rounding. */
  bool Contains(std::int32_t facet, const glm::dvec3& point, CellHit& hit) const
  {
    return this->Contains(facet, point, 0.0, hit);
  }

  /** As above, with walls widened by `wall`, in barycentric coordinates. */
  bool Contains(std::int32_t facet, const glm::dvec3& point, double wall, CellHit& hit) const;

  /** A tube around all points that Contains accepts for `facet` without widened walls. */
  TubeBounds GetBounds(std::int32_t facet) const;

  /**
   * Largest ratio of the distance between a point and a corner's cut of the plane to the distance
   * between the point and that corner.
   */
  static double GetLargestStretch();

  const glm::dvec3& GetEye() const { return this->Eye; }
  const RayReport& GetReport() const { return this->Report; }

private:
  struct Corner
  {
    glm::dvec3 Position;
    glm::dvec3 Ray;
  };

  using CornerTriple = std::array<const Corner*, 3>;

  struct CrossSection;

  CornerTriple GetCorners(std::int32_t facet) const;
  bool IsBehind(const CornerTriple& corner, const CrossSection& cross, const glm::dvec3& weights,
    double tolerance) const;
  bool IsEyeOnFacet(const Membrane::Facet& facet) const;
  void CountRays(const std::vector<RayKind>& kinds);

  const Membrane* Surface = nullptr;
  glm::dvec3 Eye{ 0.0 };
  std::vector<Corner> Corners;
  RayReport Report;
};

}
