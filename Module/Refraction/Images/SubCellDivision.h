// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Division of a patch into triangular sub-cells whose refracted rays exist and are nearly linear.
 *
 * Whether and where a side of a sub-cell is divided depends on that side alone, so that neighbours,
 * of the same patch or of two, have the same nodes. Rays exist up to a limit of the angle of
 * incidence: the critical angle, or a right angle at a silhouette of the membrane. A side that
 * crosses the limit is divided there, and sub-cells end there, too. Facets may be much wider than
 * their distance from the eye, which sees such a limit in a small part of them.
 */
#pragma once

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/SharedNodes.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace meniscus
{

/** A corner of a sub-cell. */
struct SubCellNode
{
  glm::dvec2 B;
  RefractedPoint From;
  bool IsAtLimit = false; ///< the last place with a ray on a side that crosses the limit
};

using SubCell = std::array<SubCellNode, 3>;

/** Length of the longest side. */
double GetSize(const SubCell& nodes);

/** True if a place of the patch is in the sub-cell or on its border. */
bool IsInside(const SubCell& nodes, const glm::dvec2& b);

/**
 * Place where the sub-cell's rays pass a point most closely, if their moments about the point are
 * linear.
 */
glm::dvec2 GuessSight(const SubCell& nodes, const glm::dvec3& point);

/**
 * Calls `visit(part)` for the parts of a triangle, some of whose sides are divided at `middle`;
 * both are opposite the corners. One divided side: two halves. Two: the corner between them is cut
 * off and the rest is halved.
 */
template <typename Node, typename Visit>
void VisitParts(const std::array<Node, 3>& nodes, const std::array<Node, 3>& middle,
  const std::array<bool, 3>& isDivided, const Visit& visit)
{
  using Triangle = std::array<Node, 3>;
  const int count = isDivided[0] + isDivided[1] + isDivided[2];
  if (count == 3)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      visit(Triangle{ nodes[k], middle[(k + 2) % 3], middle[(k + 1) % 3] });
    }
    visit(middle);
    return;
  }
  std::size_t k = 0;
  while (isDivided[k] != (count == 1))
  {
    ++k;
  }
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  if (count == 1)
  {
    visit(Triangle{ nodes[k], nodes[i], middle[k] });
    visit(Triangle{ nodes[k], middle[k], nodes[j] });
    return;
  }
  visit(Triangle{ nodes[k], middle[j], middle[i] });
  visit(Triangle{ middle[j], nodes[i], nodes[j] });
  visit(Triangle{ middle[j], nodes[j], middle[i] });
}

class SubCellDivision
{
public:
  /**
   * `tolerance` is the largest error of linear interpolation in a sub-cell, as an angle in radians
   * at the eye, at the distances `nearest` and `farthest` behind the membrane. `shared` has the
   * nodes of divisions with the same parameters.
   */
  SubCellDivision(const CurvedMembraneSolver& geometry, double tolerance, double nearest,
    double farthest, SharedNodes& shared);

  /**
   * Calls `map(patch, nodes)` for each sub-cell of a patch. Sub-cells for whose rays
   * `isOutside(nodes)` is true are left out before they are divided further.
   */
  template <typename IsOutside, typename Map>
  void Visit(std::int32_t facet, const IsOutside& isOutside, const Map& map) const
  {
    const SubCell nodes = this->MakeCorners(facet);
    const bool allValid = nodes[0].From.IsValid && nodes[1].From.IsValid && nodes[2].From.IsValid;
    if (allValid && isOutside(nodes))
    {
      return;
    }
    const CurvedPatch patch = this->Geometry.GetPatches().GetPatch(facet);
    if (allValid && !this->IsDivided(facet, patch, nodes))
    {
      map(patch, nodes);
      return;
    }
    this->Divide(patch, nodes, 0, isOutside, map);
  }

private:
  template <typename IsOutside, typename Map>
  void Divide(const CurvedPatch& patch, const SubCell& nodes, int depth, const IsOutside& isOutside,
    const Map& map) const
  {
    const bool allValid = nodes[0].From.IsValid && nodes[1].From.IsValid && nodes[2].From.IsValid;
    if (allValid && isOutside(nodes))
    {
      return;
    }
    SubCell middle; // opposite the corners
    std::array<bool, 3> split;
    for (std::size_t k = 0; k < 3; ++k)
    {
      split[k] = this->FindSplit(patch, nodes[(k + 1) % 3], nodes[(k + 2) % 3], depth, middle[k]);
    }
    const int count = split[0] + split[1] + split[2];
    if (count == 0)
    {
      if (allValid)
      {
        map(patch, nodes);
      }
      return;
    }
    const int next = this->IsWide(nodes) ? depth : depth + 1;
    VisitParts(nodes, middle, split,
      [this, &patch, next, &isOutside, &map](const SubCell& part)
      { this->Divide(patch, part, next, isOutside, map); });
  }

  SubCell MakeCorners(std::int32_t facet) const;
  bool IsDivided(std::int32_t facet, const CurvedPatch& patch, const SubCell& nodes) const;
  SubCellNode MakeNode(const CurvedPatch& patch, const glm::dvec2& b) const;
  bool FindSplit(const CurvedPatch& patch, const SubCellNode& a, const SubCellNode& b, int depth,
    SubCellNode& split) const;
  bool IsWide(const SubCellNode& a, const SubCellNode& b) const;
  bool IsWide(const SubCell& nodes) const;
  SubCellNode FindLimit(
    const CurvedPatch& patch, const SubCellNode& valid, const SubCellNode& invalid) const;
  bool IsBent(const SubCellNode& a, const SubCellNode& middle, const SubCellNode& b) const;
  bool MayReachLimit(const SubCellNode& a, const SubCellNode& middle, const SubCellNode& b) const;
  bool IsOffLimit(const SubCellNode& a, const SubCellNode& middle, const SubCellNode& b) const;
  double GetIncidence(const SubCellNode& node) const;
  double GetAngle(const SubCellNode& a, const SubCellNode& b) const;

  const CurvedMembraneSolver& Geometry;
  double Tolerance;
  double Distance[2];
  double Limit; ///< angle of incidence up to which rays exist
  SharedNodes& Shared;
};

}
