// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Edge of a facet, by its vertices, and the facet's other vertex. */
struct SurfaceEdge
{
  std::array<std::int32_t, 2> Ends;
  std::int32_t Opposite;
};

/** Pieces of a surface that are connected by edges with two facets. */
struct SurfacePieces
{
  std::vector<std::int32_t> PieceOf; ///< per facet
  std::int32_t Count = 0;
  std::vector<SurfaceEdge> Borders; ///< edges with one facet
  /** Per facet and corner: the other facet at the opposite edge, or -1 if none or several. */
  std::vector<std::array<std::int32_t, 3>> Neighbours;
  std::size_t NonManifoldFacets = 0; ///< facets with an edge that three or more of them share
  std::size_t TurnedFacets = 0;
  bool IsOneSided = false; ///< true for a surface such as a Moebius band: no winding is consistent
                           ///< over all facets
};

/**
 * Finds the pieces of a surface and makes the winding of the facets of each piece consistent: the
 * minority is reversed; of two equal halves, the half without the piece's first facet. If any piece
 * is one-sided, no facet is reversed.
 */
SurfacePieces OrientFacets(std::vector<std::array<std::int32_t, 3>>& facets, std::size_t points);

/**
 * Reverses normals that contradict the surface: a normal is reversed if, with respect to all facets
 * of its vertex, it is on the other side than the majority of the corners of its piece. A whole
 * piece whose normals are opposite to the winding of its facets is kept: the normals define the
 * eye's side. Returns the number of reversed normals.
 */
std::size_t OrientNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const SurfacePieces& pieces,
  std::vector<glm::dvec3>& normals);

}
