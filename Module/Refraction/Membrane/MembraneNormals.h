// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Writes the unit normal of every vertex that `wanted` marks. At a vertex that facets surround, it
 * is the sum of (a x b) / (|a|^2 |b|^2) over the facets with the edges a and b at the vertex (N.
 * Max, "Weights for computing vertex normals from facet normals", 1999), which is exact on spheres
 * for facets of any shape. At a border, where the facets of one side give first-order errors, the
 * normals of the neighbours are continued; see NormalFit. The border of a crease is not continued:
 * there the normal is the sum over the facets.
 *
 * Borders and neighbours are taken from an OpenMesh half-edge mesh. A facet that would make the
 * mesh non-manifold is added with its own copies of its corners; it still contributes to the
 * normals of its vertices.
 *
 * Half-edges exist only on oriented, manifold meshes. OrientFacets() and JoinCoincidentEdges() work
 * on facets before they are oriented, and a membrane keeps facets whose edge three or more of them
 * share, so these functions and CurvedPatches have tables of neighbours of their own.
 *
 * Where the normals of the facets around a vertex cancel out, the normal of the first of them is
 * taken, so that every vertex of a facet has a normal. The other values of `normals` are neither
 * used nor changed.
 */
void ComputeVertexNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<bool>& wanted,
  std::vector<glm::dvec3>& normals);

}
