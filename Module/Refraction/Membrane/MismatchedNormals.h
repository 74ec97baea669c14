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

/**
 * Number of vertices whose normals were examined, and of those whose normal cannot belong to the
 * surface.
 */
struct MismatchedNormals
{
  std::size_t Examined = 0;
  std::size_t Foreign = 0;

  /** True if most of the normals are foreign. Single normals may be so at creases or on purpose. */
  bool AreMost() const { return 2 * this->Foreign > this->Examined; }
};

/**
 * Detects normals of another surface, for example when points were moved and normals were not. Some
 * of the vertices that are surrounded by facets are examined. A normal is foreign if its distance
 * from the mean of the facets' normals is more than twice the largest distance of any of these from
 * it: normals of a smooth surface are nearer to that mean than the facets' normals by one order of
 * the facet size. Where the facets turn by as much as the two surfaces differ, foreign normals
 * cannot be detected.
 *
 * @param positions and `normals` of unit length, one per vertex.
 * @param coordinate Largest coordinate before the positions were moved; its rounding in single
 *   precision may have turned facets.
 */
MismatchedNormals FindMismatchedNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<glm::dvec3>& normals,
  double coordinate);

/**
 * Finds single normals that cannot belong to the surface. A normal is wild if it is foreign, as
 * above but at any vertex, and deviates by more than CreaseAngle both from the facets around it and
 * from the normal that continues the given normals of its neighbours. Normals of a smooth surface
 * on a coarse mesh fit their neighbours, mean normals of a crease fit their facets. Returns nothing
 * if more than half of the normals are wild, at vertices that facets surround: nothing says that
 * the others are better.
 *
 * The parameters have the same meanings as in FindMismatchedNormals().
 */
std::vector<std::int32_t> FindWildNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<glm::dvec3>& normals,
  double coordinate);

}
