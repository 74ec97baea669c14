// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Prefetch.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** A box with sides along the axes; empty by default. */
struct AxisBox
{
  glm::dvec3 Low{ std::numeric_limits<double>::max() };
  glm::dvec3 High{ std::numeric_limits<double>::lowest() };

  void Add(const AxisBox& other)
  {
    this->Low = glm::min(this->Low, other.Low);
    this->High = glm::max(this->High, other.High);
  }
};

/** Parameters t of a tube for which it may be inside a box; empty if `From` is above `To`. */
struct TubeRange
{
  double From;
  double To;
};

/** A tube in the form that boxes are clipped with. */
class TubeClip
{
public:
  explicit TubeClip(const TubeBounds& tube);

  /** Part of [0, most] for which a ray of the tube may be inside the box. */
  TubeRange Clip(const AxisBox& box, double most) const
  {
    TubeRange range{ 0.0, most };
    for (int axis = 0; axis < 3; ++axis)
    {
      const double above = (box.High[axis] - this->Low[axis]) * this->InverseLow[axis];
      const double below = (box.Low[axis] - this->High[axis]) * this->InverseHigh[axis];
      if (this->InverseLow[axis] > 0.0)
      {
        range.To = std::min(range.To, above);
      }
      else
      {
        range.From = std::max(range.From, above);
      }
      if (this->InverseHigh[axis] > 0.0)
      {
        range.From = std::max(range.From, below);
      }
      else
      {
        range.To = std::min(range.To, below);
      }
    }
    return range;
  }

  /** Bounds of the beginnings, and reciprocals of the bounds of directions, which are not 0. */
  const glm::dvec3& GetLow() const { return this->Low; }
  const glm::dvec3& GetHigh() const { return this->High; }
  const glm::dvec3& GetInverseLow() const { return this->InverseLow; }
  const glm::dvec3& GetInverseHigh() const { return this->InverseHigh; }

private:
  glm::dvec3 Low;
  glm::dvec3 High;
  glm::dvec3 InverseLow;
  glm::dvec3 InverseHigh;
};

/**
 * A binary tree of boxes, for the facets that the rays of a tube may meet. A single ray is a tube
 * whose boxes of starts and directions are points.
 */
class BoxTree
{
public:
  void Build(const std::vector<AxisBox>& boxes);

  /**
   * Calls `visit(item, range)` for every box that a ray of the tube may meet at a parameter of at
   * most `most`; nearer boxes come first where two are divided. `visit` returns the limit from
   * then on.
   */
  template <typename Visitor>
  void Visit(const TubeBounds& tube, double most, Visitor&& visit) const
  {
    this->Visit(
      tube, most, [](const AxisBox&) { return true; }, visit);
  }
  /**
   * Visits the same boxes, except those within a larger box for which `mayMeet(box)` is false. The
   * test is made once for each node that holds several boxes.
   */
  template <typename Test, typename Visitor>
  void Visit(const TubeBounds& tube, double most, const Test& mayMeet, Visitor&& visit) const;

  std::int64_t GetBytes() const
  {
    return static_cast<std::int64_t>(this->Nodes.capacity() * sizeof(Node));
  }

private:
  struct Node
  {
    AxisBox Box;
    std::int32_t Item;  ///< of a leaf; NoItem for an inner node
    std::int32_t Right; ///< second child; the first one follows its parent
  };
  static constexpr std::int32_t NoItem = -1;
  // Each node divides its boxes in two by count, so 2^31 boxes need at most 31 levels.
  static constexpr std::size_t StackSize = 64;

  void BuildNode(std::vector<std::int32_t>::iterator begin, std::vector<std::int32_t>::iterator end,
    const std::vector<AxisBox>& boxes);

  std::vector<Node> Nodes;
};

//------------------------------------------------------------------------------
template <typename Test, typename Visitor>
void BoxTree::Visit(const TubeBounds& tube, double most, const Test& mayMeet, Visitor&& visit) const
{
  if (this->Nodes.empty())
  {
    return;
  }
  struct Entry
  {
    std::size_t Node;
    TubeRange Range;
  };
  const TubeClip clip(tube);
  std::array<Entry, StackSize> stack;
  std::size_t depth = 0;
  const TubeRange whole = clip.Clip(this->Nodes[0].Box, most);
  if (whole.From <= whole.To)
  {
    stack[depth++] = { 0, whole };
  }
  while (depth > 0)
  {
    const Entry entry = stack[--depth];
    if (entry.Range.From > most)
    {
      continue;
    }
    const Node& node = this->Nodes[entry.Node];
    if (node.Item != NoItem)
    {
      most = visit(node.Item, entry.Range);
      continue;
    }
    if (!mayMeet(node.Box))
    {
      continue;
    }
    const auto second = static_cast<std::size_t>(node.Right);
    Entry near{ entry.Node + 1, clip.Clip(this->Nodes[entry.Node + 1].Box, most) };
    Entry far{ second, clip.Clip(this->Nodes[second].Box, most) };
    if (far.Range.From < near.Range.From)
    {
      std::swap(near, far);
    }
    for (const Entry& child : { far, near })
    {
      if (child.Range.From <= child.Range.To)
      {
        stack[depth++] = child;
        // The second child of a node is far from it in memory.
        Prefetch(
          &this->Nodes[static_cast<std::size_t>(this->Nodes[child.Node].Right)], sizeof(Node));
      }
    }
  }
}

}
