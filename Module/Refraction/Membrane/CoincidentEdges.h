// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/MembraneOrientation.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Largest angle between the normals on the two sides of an edge over which a surface is taken to be
 * smooth, 30 degrees, as in vtkPolyDataNormals. Beyond it, the edge is a crease.
 */
constexpr double CreaseAngle = 0.52359877559829887; // pi / 6

/**
 * Joins facets that have an edge at the same place but different vertices there, as in files that
 * list the corners of each triangle. Coordinates must be equal. An edge of two facets is joined if
 * the surface is smooth across it: at each of its ends, the normals of both vertices differ by at
 * most CreaseAngle and the facets by less than 90 degrees; if one of the normals is zero, the
 * facets by at most CreaseAngle. So two sheets at the same place stay two. Edges of more than two
 * facets, and vertices that touch without a common edge, are not joined.
 *
 * @param borders edges of `facets` that have no other facet
 * @param normals per vertex, of unit length or zero
 * @return per vertex, the vertex that replaces it in `facets`, which has the smallest index.
 *   Empty, and `facets` unchanged, if no vertices are joined.
 */
std::vector<std::int32_t> JoinCoincidentEdges(const std::vector<glm::dvec3>& positions,
  const std::vector<SurfaceEdge>& borders, const std::vector<glm::dvec3>& normals,
  std::vector<std::array<std::int32_t, 3>>& facets);

}
