// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/**
 * Cones around the outward normals of the faces below each node of a BoundaryTree: a ray that looks
 * for a way into the mesh passes over nodes by all of whose faces it would leave. They are half of
 * a closed surface, and all that is around the place where a ray has left.
 */
class BoundaryCones
{
public:
  void Build(const TetrahedralMesh& mesh, const BoundaryTree& tree);

  /** True if a ray of this direction, a unit vector, leaves the mesh by each face below the node.
   */
  bool LeavesByAll(std::size_t node, const glm::dvec3& direction) const
  {
    const Cone& cone = this->Cones[node];
    return glm::dot(direction, glm::dvec3(cone.Axis)) > cone.Sine;
  }

private:
  struct Cone
  {
    glm::vec3 Axis{ 0.0f };
    /** Sine of the angle between axis and normals, rounded up; 2 if it is not below 90 degrees. */
    float Sine = 2.0f;
  };
  std::vector<Cone> Cones;
};

}
