// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Graded/BoundaryCones.h"
#include "Volume/Graded/EntryRaster.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Crossing of a straight ray with a face of the boundary. */
struct BoundaryCrossing
{
  /** Number of the face in BoundaryTree::GetFaces(); -1 if there is no crossing. */
  std::int32_t Face = -1;
  /** Distance from the ray's origin in units of its direction's length, >= 0. */
  double Distance = 0.0;
  /**
   * Largest error of the distance: DistanceError, and more for a face that the ray grazes. If it is
   * TetrahedralMesh::PositionUnit, the error may be larger; the ray is in the plane of the face
   * then by the rounding of the mesh's positions.
   */
  double Error = 0.0;
  /** Barycentric weights of the face's vertices, in their order; >= 0, with the sum 1. */
  std::array<double, 3> Weights{};
  /** True if the ray enters the mesh by the face. */
  bool Enters = false;
};

/**
 * First crossing of a straight ray with the boundary of a mesh.
 *
 * No ray passes between two faces at an edge, and a ray through an edge or a vertex crosses all
 * faces at it (TriangleCrossing.h).
 */
class BoundaryCrossings
{
public:
  /**
   * Largest error of a distance to a face that is not seen at a small angle, in units of the mesh's
   * radius: positions of at most 1 in size, 32 roundings of 2^-53 each in weights, position and
   * projection.
   */
  static constexpr double DistanceError = 0x1p-48;

  /**
   * @param mesh, tree as they are at each search; all must outlive this object.
   * @param cones of the tree, for quicker searches with the same results; null for none.
   */
  BoundaryCrossings(
    const TetrahedralMesh& mesh, const BoundaryTree& tree, const BoundaryCones* cones = nullptr)
    : Mesh(mesh)
    , Tree(tree)
    , Cones(cones)
  {
  }

  /**
   * Finds the nearest crossing; of equally near crossings, the crossing of the lowest number.
   * @param origin relative to the mesh's centre, in units of its radius.
   * @param direction unit vector.
   * @param leavingToo true if faces by which the ray leaves the mesh count, too.
   * @param excluded numbers of faces that do not count within their error of the origin.
   * @param passed numbers of faces that do not count at any distance.
   */
  BoundaryCrossing Find(const glm::dvec3& origin, const glm::dvec3& direction, bool leavingToo,
    const std::vector<std::int32_t>& excluded,
    const std::vector<std::int32_t>& passed = std::vector<std::int32_t>()) const;

  /** Finds the nearest entry among some of the faces, which have all that are the first. */
  BoundaryCrossing FindAmong(const glm::dvec3& origin, const glm::dvec3& direction,
    const EntryFaces& faces, std::size_t ray) const;

private:
  struct Line;
  bool Cross(const Line& line, std::int32_t face, BoundaryCrossing& crossing) const;

  const TetrahedralMesh& Mesh;
  const BoundaryTree& Tree;
  const BoundaryCones* Cones;
};

}
