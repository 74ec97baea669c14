// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Membrane_MismatchedNormals_h
#define meniscus_Refraction_Membrane_MismatchedNormals_h

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Vertices whose normals were looked at, and those whose normal cannot be that of the surface. */
struct MismatchedNormals
{
  std::size_t Examined = 0;
  std::size_t Foreign = 0;

  /** Single normals may be off at creases or on purpose; most are not. */
  bool AreMost() const { return 2 * this->Foreign > this->Examined; }
};

/**
 * Finds whether normals are those of another surface, as after points were moved and normals were
 * not. Looked at are some of the vertices that facets surround. A normal is foreign if it is
 * farther from the mean of the facets' normals than twice what any of these is: normals of a smooth
 * surface are nearer to that mean than the facets', by an order of their size. Where facets turn by
 * as much as the surfaces differ it cannot be told.
 *
 * @param positions and `normals` of unit length, one per vertex.
 * @param coordinate  The largest coordinate before the positions were moved; what it is rounded by
 *   in single precision may turn facets.
 */
MismatchedNormals FindMismatchedNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<glm::dvec3>& normals,
  double coordinate);

}

#endif
