// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Part of a triangle in front of the membrane, as polygons between the triangle's sides and the
 * curve along which the triangle meets the membrane. The refracted part ends at the same pieces of
 * the curve, so the two parts meet bit by bit and have the same resolution.
 */
#pragma once

#include "Refraction/Images/PrimitiveMapper.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus
{

class FrontOutline
{
public:
  /** Corners, with the winding of the triangle. */
  using Polygon = std::vector<TrianglePoint>;

  /** `corners` of the triangle; `isFront` marks the corners in front of the membrane. */
  FrontOutline(const std::vector<WaterlinePiece>& waterline,
    const std::array<glm::dvec3, 3>& corners, const std::array<bool, 3>& isFront);

  /**
   * Computes the part as convex polygons. Returns false if the pieces do not separate the corners
   * in front from the others along each side, or if they leave a hole in the part.
   */
  bool Find(std::vector<Polygon>& polygons);

private:
  static constexpr std::size_t None = static_cast<std::size_t>(-1);

  struct Node
  {
    TrianglePoint At;
    std::array<std::size_t, 2> Next = { None, None }; ///< neighbours on the waterline
    std::array<bool, 2> IsForward = {}; ///< true if the part in front is on the left in this
                                        ///< direction
    std::size_t Along = None;           ///< next node along the triangle's sides
  };

  std::size_t FindNode(const TrianglePoint& at);
  bool Link(const WaterlinePiece& piece);
  bool AddLink(std::size_t from, std::size_t to, bool isForward);
  bool Unlink(std::size_t from, std::size_t to);
  bool IsEnd(std::size_t node) const
  {
    return (this->Nodes[node].Next[0] == None) != (this->Nodes[node].Next[1] == None);
  }
  bool FollowSide(std::size_t from);
  std::size_t GoOn(std::size_t node, std::size_t before) const;
  bool CollectLoop(std::size_t first, std::vector<bool>& seen, std::vector<Polygon>& polygons);

  std::vector<Node> Nodes;         ///< the triangle's corners first
  std::vector<std::size_t> Sorted; ///< nodes in the order of their coordinates
  std::array<bool, 3> IsFront;
  bool Broken = false;
};

}
