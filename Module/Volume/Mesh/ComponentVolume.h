// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <vector>

namespace meniscus
{

/** A multiple of the signed volume of the cell with ascending vertices. */
inline double SignedVolume(
  const std::vector<glm::ivec3>& positions, const TetrahedralMesh::Cell& cell)
{
  const auto& v = cell.Vertices;
  const glm::dvec3 origin(positions[v[0]]);
  return glm::dot(
    glm::cross(glm::dvec3(positions[v[1]]) - origin, glm::dvec3(positions[v[2]]) - origin),
    glm::dvec3(positions[v[3]]) - origin);
}

/**
 * Fraction of a component's volume that may remain by rounding where volumes cancel: 2^-52 for each
 * of up to 2^29 cells.
 */
constexpr double NegligibleVolume = 1.0 / (1 << 23);

/** Volume of connected cells, each with the sign of its orientation. */
struct ComponentVolume
{
  double Sum = 0.0;
  /** Sum of the magnitudes. */
  double Size = 0.0;

  void Add(double volume)
  {
    this->Sum += volume;
    this->Size += std::abs(volume);
  }
  /** Adds a part whose orientation is relative to `sign`. */
  void Add(const ComponentVolume& part, int sign)
  {
    this->Sum += sign * part.Sum;
    this->Size += part.Size;
  }
  /** True if there are volumes and only a fraction of them remains in the sum. */
  bool Cancels(double fraction) const
  {
    return this->Size > 0.0 && std::abs(this->Sum) <= fraction * this->Size;
  }
};

}
