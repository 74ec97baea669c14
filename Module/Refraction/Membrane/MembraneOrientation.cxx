// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/MembraneOrientation.h"

#include "Common/GroupedItems.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace meniscus
{
namespace
{

using Facet = std::array<std::int32_t, 3>;

/** The facets around each vertex. */
GroupedItems ListFans(const std::vector<Facet>& facets, std::size_t points)
{
  GroupedItems fans;
  fans.Set(points,
    [&facets](const auto& visit)
    {
      for (std::size_t i = 0; i < facets.size(); ++i)
      {
        for (const std::int32_t vertex : facets[i])
        {
          visit(static_cast<std::size_t>(vertex), static_cast<std::int32_t>(i));
        }
      }
    });
  return fans;
}

/** The other facet at an edge, and whether it runs along the edge in the same direction. */
struct FacetAcross
{
  std::int32_t Facet = -1; ///< -1: none, or several
  bool SameWay = false;
  bool AreSeveral = false;
};

FacetAcross FindAcross(
  const std::vector<Facet>& facets, const GroupedItems& fans, std::int32_t self, std::size_t corner)
{
  const Facet& own = facets[static_cast<std::size_t>(self)];
  const std::int32_t a = own[(corner + 1) % 3];
  const std::int32_t b = own[(corner + 2) % 3];
  FacetAcross result;
  for (const std::int32_t facet : fans[static_cast<std::size_t>(a)])
  {
    const Facet& other = facets[static_cast<std::size_t>(facet)];
    const auto at =
      static_cast<std::size_t>(std::find(other.begin(), other.end(), a) - other.begin());
    const bool isNext = other[(at + 1) % 3] == b;
    if (facet == self || (!isNext && other[(at + 2) % 3] != b))
    {
      continue;
    }
    if (result.Facet >= 0)
    {
      return { -1, false, true };
    }
    result = { facet, isNext, false };
  }
  return result;
}

/**
 * Visits a piece from `seed`; `turned` marks the facets that have to be reversed to agree with it.
 */
void FillPiece(const std::vector<Facet>& facets, const GroupedItems& fans, std::int32_t seed,
  SurfacePieces& pieces, std::vector<bool>& turned, std::vector<std::int32_t>& piece)
{
  piece.assign(1, seed);
  pieces.PieceOf[static_cast<std::size_t>(seed)] = pieces.Count;
  for (std::size_t i = 0; i < piece.size(); ++i)
  {
    const std::int32_t facet = piece[i];
    bool isNonManifold = false;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const FacetAcross across = FindAcross(facets, fans, facet, corner);
      isNonManifold = isNonManifold || across.AreSeveral;
      pieces.Neighbours[static_cast<std::size_t>(facet)][corner] = across.Facet;
      if (across.Facet < 0)
      {
        if (!across.AreSeveral)
        {
          const Facet& own = facets[static_cast<std::size_t>(facet)];
          pieces.Borders.push_back(
            { { own[(corner + 1) % 3], own[(corner + 2) % 3] }, own[corner] });
        }
        continue;
      }
      const auto other = static_cast<std::size_t>(across.Facet);
      const bool wanted = turned[static_cast<std::size_t>(facet)] != across.SameWay;
      if (pieces.PieceOf[other] < 0)
      {
        pieces.PieceOf[other] = pieces.Count;
        turned[other] = wanted;
        piece.push_back(across.Facet);
      }
      else if (turned[other] != wanted)
      {
        pieces.IsOneSided = true;
      }
    }
    pieces.NonManifoldFacets += isNonManifold ? 1 : 0;
  }
}

}

//------------------------------------------------------------------------------
SurfacePieces OrientFacets(std::vector<Facet>& facets, std::size_t points)
{
  const GroupedItems fans = ListFans(facets, points);
  SurfacePieces pieces;
  pieces.PieceOf.assign(facets.size(), -1);
  pieces.Neighbours.resize(facets.size());
  std::vector<bool> turned(facets.size(), false);
  std::vector<std::int32_t> piece;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    if (pieces.PieceOf[i] >= 0)
    {
      continue;
    }
    FillPiece(facets, fans, static_cast<std::int32_t>(i), pieces, turned, piece);
    ++pieces.Count;
    const auto isTurned = [&turned](std::int32_t f) { return turned[static_cast<std::size_t>(f)]; };
    const auto count =
      static_cast<std::size_t>(std::count_if(piece.begin(), piece.end(), isTurned));
    const bool others = 2 * count > piece.size();
    for (const std::int32_t f : piece)
    {
      turned[static_cast<std::size_t>(f)] = isTurned(f) != others;
    }
  }
  for (std::size_t i = 0; !pieces.IsOneSided && i < facets.size(); ++i)
  {
    if (turned[i])
    {
      std::swap(facets[i][1], facets[i][2]);
      std::swap(pieces.Neighbours[i][1], pieces.Neighbours[i][2]);
      ++pieces.TurnedFacets;
    }
  }
  return pieces;
}

//------------------------------------------------------------------------------
std::size_t OrientNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<Facet>& facets, const SurfacePieces& pieces, std::vector<glm::dvec3>& normals)
{
  // Number of corners whose normal is on the side of the winding, minus the number of the others.
  std::vector<std::int64_t> balance(static_cast<std::size_t>(pieces.Count), 0);
  const auto forEachCorner = [&positions, &facets, &normals](const auto& visit)
  {
    for (std::size_t i = 0; i < facets.size(); ++i)
    {
      const auto at = [&positions, &facets, i](std::size_t k) -> const glm::dvec3&
      { return positions[static_cast<std::size_t>(facets[i][k])]; };
      const glm::dvec3 winding = glm::cross(at(1) - at(0), at(2) - at(0));
      for (const std::int32_t vertex : facets[i])
      {
        const double along = glm::dot(winding, normals[static_cast<std::size_t>(vertex)]);
        visit(i, static_cast<std::size_t>(vertex), along > 0.0 ? 1 : (along < 0.0 ? -1 : 0));
      }
    }
  };
  forEachCorner([&balance, &pieces](std::size_t facet, std::size_t, int side)
    { balance[static_cast<std::size_t>(pieces.PieceOf[facet])] += side; });
  std::vector<signed char> votes(normals.size(), 0); // 1: at least one facet agrees; -1: all of
                                                     // them disagree
  forEachCorner(
    [&balance, &pieces, &votes](std::size_t facet, std::size_t vertex, int side)
    {
      const bool turned = balance[static_cast<std::size_t>(pieces.PieceOf[facet])] < 0;
      const bool objects = side != 0 && (side < 0) != turned;
      votes[vertex] = objects && votes[vertex] <= 0 ? -1 : 1;
    });
  std::size_t count = 0;
  for (std::size_t i = 0; i < votes.size(); ++i)
  {
    if (votes[i] < 0)
    {
      normals[i] = -normals[i];
      ++count;
    }
  }
  return count;
}

}
