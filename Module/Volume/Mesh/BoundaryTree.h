// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Bounding volume hierarchy over boundary faces, in preorder, for traversal without a stack: a node
 * that is hit is followed by the next node, a node that is missed by its Skip. Of n faces a node's
 * first child has n / 2, rounded down: vtkTetrahedraEntryTilesCS finds subtrees by that.
 */
class BoundaryTree
{
public:
  struct Node
  {
    /** Centre and half extents of the box, relative to the mesh's centre. */
    glm::vec3 Center;
    glm::vec3 Half;
    /** Index of the node that follows this node's subtree. */
    std::int32_t Skip;
    /** Index of a leaf's face in GetFaces(); -1 for an inner node. */
    std::int32_t Face;
  };

  void Build(const TetrahedralMesh& mesh);

  /**
   * Fits the boxes to new positions of the vertices and keeps the order of the faces, which takes
   * linear time. Returns false if Build() makes a better tree: if a ray is expected to meet more
   * than twice as many boxes as in the tree that was built, by the surface area heuristic.
   * @pre the mesh has the boundary that the tree was built of, but for positions and orientation.
   */
  bool Refit(const TetrahedralMesh& mesh);

  const std::vector<Node>& GetNodes() const { return this->Nodes; }
  /** Boundary faces in leaf order. */
  const std::vector<BoundaryFace>& GetFaces() const { return this->Faces; }

private:
  struct Box;
  struct Item;
  void BuildSubtree(std::vector<Item>& items, std::size_t first, std::size_t last);
  double FitBoxes(const TetrahedralMesh& mesh);

  std::vector<Node> Nodes;
  std::vector<BoundaryFace> Faces;
  /** Expected number of boxes that a ray through the root meets in the tree that was built. */
  double BuiltCost = 0.0;
};

}
