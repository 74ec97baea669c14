// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Membrane_MembraneOrientation_h
#define meniscus_Refraction_Membrane_MembraneOrientation_h

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Pieces of a surface that hang together by edges with two facets. */
struct SurfacePieces
{
  std::vector<std::int32_t> PieceOf; ///< per facet
  std::int32_t Count = 0;
  std::size_t TurnedFacets = 0;
  bool IsOneSided = false; ///< as a Moebius band is: no way of winding fits all facets
};

/**
 * Winds the facets of each piece alike: those that are fewer than half of their piece are turned,
 * of two halves the one without the piece's first facet. Nothing is turned in a surface with a
 * one-sided piece.
 */
SurfacePieces OrientFacets(std::vector<std::array<std::int32_t, 3>>& facets, std::size_t points);

/**
 * Turns normals that contradict the surface: a vertex whose normal is on the other side of all of
 * its facets than those of the most corners of its piece are. Whole pieces whose normals are on the
 * other side of their facets' winding stay: normals say where the eye is. Returns how many were
 * turned.
 */
std::size_t OrientNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const SurfacePieces& pieces,
  std::vector<glm::dvec3>& normals);

}

#endif
