// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/BackPieces.h"

#include "Filters/Common/ThreadedLoop.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace meniscus
{
namespace
{

/** Number of facets of each piece that is open and shows no eye its front, by pieces; else 0. */
std::vector<std::size_t> ListBacks(
  const Membrane& surface, const std::vector<glm::dvec3>& eyes, double side)
{
  const SurfacePieces& pieces = surface.GetPieces();
  const auto count = static_cast<std::size_t>(pieces.Count);
  std::vector<bool> isOpen(count, false);
  std::vector<bool> isSeen(count, false);
  std::vector<std::size_t> facets(count, 0);
  for (std::size_t i = 0; i < surface.GetFacets().size(); ++i)
  {
    const auto piece = static_cast<std::size_t>(pieces.PieceOf[i]);
    const auto& neighbours = pieces.Neighbours[i];
    isOpen[piece] = isOpen[piece] ||
      std::any_of(
        neighbours.begin(), neighbours.end(), [](std::int32_t facet) { return facet < 0; });
    ++facets[piece];
    for (const std::int32_t vertex : surface.GetFacets()[i])
    {
      const auto v = static_cast<std::size_t>(vertex);
      isSeen[piece] = isSeen[piece] ||
        std::any_of(eyes.begin(), eyes.end(),
          [&](const glm::dvec3& eye)
          {
            const glm::dvec3 sight = eye - surface.GetOrigin() - surface.GetPositions()[v];
            return side * glm::dot(sight, surface.GetNormals()[v]) > 0.0;
          });
    }
  }
  for (std::size_t piece = 0; piece < count; ++piece)
  {
    facets[piece] = isOpen[piece] && !isSeen[piece] ? facets[piece] : 0;
  }
  return facets;
}

/** True if nothing of the surface lies between an eye and the middle of a facet. */
bool IsSeenDirectly(const RefractingSurface& surface, std::int32_t facet, const glm::dvec3& eye)
{
  const glm::dvec3 middle =
    surface.GetPatches().GetPatch(facet).Evaluate(glm::dvec2(1.0 / 3.0)).Position;
  const glm::dvec3 origin = eye - surface.GetMembrane().GetOrigin();
  const double distance = glm::length(middle - origin);
  SurfaceCrossing first;
  return distance > 0.0 && std::isfinite(distance) &&
    surface.FindCrossing(origin, (middle - origin) / distance, 0, 0.0, 2.0 * distance, first) &&
    first.Facet == facet;
}

}

//------------------------------------------------------------------------------
std::size_t CountBackFacets(
  RefractingSurface& surface, const std::vector<glm::dvec3>& eyes, double side)
{
  const SurfacePieces& pieces = surface.GetMembrane().GetPieces();
  if (pieces.Count < 2)
  {
    return 0;
  }
  const std::vector<std::size_t> backs = ListBacks(surface.GetMembrane(), eyes, side);
  if (std::all_of(backs.begin(), backs.end(), [](std::size_t facets) { return facets == 0; }))
  {
    return 0;
  }
  surface.Prepare(SurfaceParts::Crossings, FacetLoop);
  constexpr std::size_t mostTries = 16;             // facets of a piece
  std::vector<std::size_t> before(backs.size(), 0); // facets of each piece so far
  std::vector<std::size_t> tries(backs.size(), 0);
  std::vector<std::size_t> seen(backs.size(), 0);
  for (std::size_t i = 0; i < pieces.PieceOf.size(); ++i)
  {
    const auto piece = static_cast<std::size_t>(pieces.PieceOf[i]);
    const std::size_t stride = backs[piece] / mostTries + 1;
    if (backs[piece] > 0 && before[piece]++ % stride == 0)
    {
      ++tries[piece];
      seen[piece] += std::any_of(eyes.begin(), eyes.end(),
        [&surface, i](const glm::dvec3& eye)
        { return IsSeenDirectly(surface, static_cast<std::int32_t>(i), eye); });
    }
  }
  std::size_t count = 0;
  for (std::size_t piece = 0; piece < backs.size(); ++piece)
  {
    count += 2 * seen[piece] > tries[piece] ? backs[piece] : 0;
  }
  return count < pieces.PieceOf.size() ? count : 0;
}

}
