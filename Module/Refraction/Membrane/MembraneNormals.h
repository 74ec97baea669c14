// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Membrane_MembraneNormals_h
#define meniscus_Refraction_Membrane_MembraneNormals_h

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Writes the unit normal of every vertex that `wanted` marks: the mean of the normals of the facets
 * around it, weighted by their angles there, on an OpenMesh half-edge mesh. A facet that would make
 * the mesh non-manifold or inconsistently oriented is added with its own copies of its corners; it
 * still contributes to the normals of its vertices. Returns the number of such facets.
 *
 * Where the normals of the facets around a vertex cancel out, the normal of the first of them is
 * taken, so that every vertex of a facet has a normal.
 */
std::size_t ComputeVertexNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<bool>& wanted,
  std::vector<glm::dvec3>& normals);

}

#endif
