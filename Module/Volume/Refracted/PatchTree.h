// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_PatchTree_h
#define meniscus_Volume_Refracted_PatchTree_h

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/Membrane.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Bounding volume hierarchy over the curved patches of a surface, in preorder: a node that is hit
 * is followed by the next node, a node that is missed by its Skip. It does not depend on the view.
 */
class PatchTree
{
public:
  struct Node
  {
    /** Corners of the box, relative to the membrane's origin. */
    glm::dvec3 Low;
    glm::dvec3 High;
    /** Index of the node that follows this node's subtree. */
    std::int32_t Skip;
    /** Facet of a leaf; -1 for an inner node. */
    std::int32_t Facet;
  };

  void Build(const Membrane& surface, const CurvedPatches& patches, const RangeLoop& loop);

  const std::vector<Node>& GetNodes() const { return this->Nodes; }
  std::int64_t GetBytes() const
  {
    return static_cast<std::int64_t>(this->Nodes.capacity() * sizeof(Node));
  }

private:
  struct Item;
  void BuildSubtree(std::vector<Item>& items, std::size_t first, std::size_t last);

  std::vector<Node> Nodes;
};

}

#endif
