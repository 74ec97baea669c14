// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A bounding volume hierarchy of ray tubes.
 *
 * A cell is unbounded below its facet, so boxes do not help. A tube is the set of points s + t r
 * with s in a box of start points, r in a box of ray directions and t >= 0: its cross-section is a
 * box whose faces move linearly with t. Tubes merge exactly (box by box), so a refit for a new eye
 * is one pass of minima and maxima, and a point is tested by intersecting six half-lines of t.
 *
 * Topology depends on the facets alone and is built once per shape; bounds are refitted per eye.
 * Bounds are floats rounded outwards, in units of the membrane's radius, and wider by the rounding
 * of the test itself; queries add that of the point, so no cell is missed.
 */
#pragma once

#include "Common/Prefetch.h"
#include "Common/RangeLoop.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace meniscus
{

/** Box of start points and box of directions, in local units. */
struct TubeBounds
{
  glm::dvec3 StartLow{ std::numeric_limits<double>::max() };
  glm::dvec3 StartHigh{ std::numeric_limits<double>::lowest() };
  glm::dvec3 DirectionLow{ std::numeric_limits<double>::max() };
  glm::dvec3 DirectionHigh{ std::numeric_limits<double>::lowest() };

  /** False for the bounds of a facet without a cell. */
  bool IsValid() const { return this->StartLow.x <= this->StartHigh.x; }
  void Add(const glm::dvec3& start, const glm::dvec3& direction);
  /** Adds the rays of another tube. */
  void Add(const TubeBounds& other);
};

class RayTubeTree
{
public:
  /**
   * Points farther than this many units from the origin exceed the range of the floats in the
   * tests.
   */
  static constexpr double FarthestRadii = 0x1p100;
  /** True for a finite point within that reach of the origin, in units of this length. */
  static bool IsInReach(const glm::dvec3& point, double unit);

  /**
   * Facets are identified by their index; `centroids` of all facets are in local units.
   * `unit` is the length that becomes 1 inside the tree.
   */
  void Build(const std::vector<glm::dvec3>& centroids, double unit);

  /** Sets another unit for the same topology; Refit must follow. */
  void SetUnit(double unit) { this->Scale = 1.0 / unit; }

  /** Fits all bounds. `bounds(facet)` is called once per facet, on the threads of `loop`. */
  void Refit(const std::function<TubeBounds(std::int32_t)>& bounds, const RangeLoop& loop);

  /**
   * Calls `visit(facet)` for every facet whose tube may hold `point`, in an order fixed by the
   * topology. `visit` returns a limit: facets with this index or a larger one are skipped from then
   * on. `padding` widens every tube along the axes, in local units. The point must lie within
   * FarthestRadii.
   */
  template <typename Visitor>
  void Visit(const glm::dvec3& point, const glm::dvec3& padding, Visitor&& visit) const;

  /** True if the tube, widened by `padding`, of any facet that `chosen` marks may hold `point`. */
  bool HasAny(
    const glm::dvec3& point, const glm::dvec3& padding, const std::vector<bool>& chosen) const
  {
    bool found = false;
    this->Visit(point, padding,
      [&found, &chosen](std::int32_t facet)
      {
        found = found || chosen[static_cast<std::size_t>(facet)];
        return found ? 0 : NoFacet;
      });
    return found;
  }

private:
  static constexpr int Width = 4;
  static constexpr std::int32_t NoNode = -1;
  static constexpr std::int32_t NoFacet = std::numeric_limits<std::int32_t>::max();
  // Each node divides its facets in four by count, so 2^31 facets need at most 16 levels, each of
  // which leaves at most three more entries on the stack.
  static constexpr std::size_t StackSize = 64;

  /** Constraints of a tube: its upper sides along x, y and z, and its lower ones, negated. */
  static constexpr int Sides = 6;
  /** Bound of the rounding of a start or a point in a test, relative to it; see Overlaps(). */
  static constexpr double Rounding = 4.0 * std::numeric_limits<float>::epsilon();

  /**
   * Four children, each an inner node or one facet. They are stored by component, so that one loop
   * over lanes tests all four. Rates are never zero and the lower ones are negated, so that all six
   * constraints have the form a + t b >= 0.
   */
  struct Node
  {
    float Start[Sides][Width];
    float Direction[Sides][Width];
    std::int32_t Link[Width];       ///< inner child: its node; otherwise NoNode
    std::int32_t FirstFacet[Width]; ///< smallest facet below an inner child; the facet of a leaf;
                                    ///< NoFacet for no child
  };

  /** The point, moved against each side by the padding. */
  struct Query
  {
    float Point[Sides];
  };

  std::int32_t BuildNode(std::vector<std::int32_t>::iterator begin,
    std::vector<std::int32_t>::iterator end, const std::vector<glm::dvec3>& centroids);
  void StoreBounds(Node& node, int child, const TubeBounds& bounds) const;
  static void MergeChild(Node& node, int child, const Node& from);
  static void ClearBounds(Node& node, int child);
  Query MakeQuery(const glm::dvec3& point, const glm::dvec3& padding) const;
  static unsigned Overlaps(const Node& node, const Query& query);

  double Scale = 1.0;
  std::vector<Node> Nodes;
};

//------------------------------------------------------------------------------
inline RayTubeTree::Query RayTubeTree::MakeQuery(
  const glm::dvec3& point, const glm::dvec3& padding) const
{
  const glm::dvec3 place = point * this->Scale;
  const double reach =
    std::max({ std::fabs(place.x), std::fabs(place.y), std::fabs(place.z), 1.0 });
  Query query;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double slack = padding[axis] * this->Scale;
    const double wide = slack + Rounding * (reach + slack);
    query.Point[axis] = static_cast<float>(place[axis] - wide);
    query.Point[axis + 3] = static_cast<float>(-place[axis] - wide);
  }
  return query;
}

//------------------------------------------------------------------------------
inline unsigned RayTubeTree::Overlaps(const Node& node, const Query& query)
{
  // With u the unit roundoff: the query's coordinate, of at most reach + padding, the start and
  // their difference are rounded once each. Together they are off by at most 2 u (reach + padding)
  // + 2 u |start|; the padding and the stored start are wider by 8 u of each, which is Rounding.
  // The quotients are off by u each.
  constexpr float quotients = 1.0f + static_cast<float>(Rounding);
  float low[Width] = { 0.0f, 0.0f, 0.0f, 0.0f };
  float high[Width];
  std::fill(high, high + Width, std::numeric_limits<float>::max());
  for (int side = 0; side < Sides; ++side)
  {
    const float p = query.Point[side];
    for (int lane = 0; lane < Width; ++lane)
    {
      const float rate = node.Direction[side][lane];
      const float bound = (p - node.Start[side][lane]) / rate;
      const float raised = bound > low[lane] ? bound : low[lane];
      const float lowered = bound < high[lane] ? bound : high[lane];
      low[lane] = rate > 0.0f ? raised : low[lane];
      high[lane] = rate > 0.0f ? high[lane] : lowered;
    }
  }
  unsigned hits = 0;
  for (int lane = 0; lane < Width; ++lane)
  {
    hits |= static_cast<unsigned>(low[lane] <= high[lane] * quotients) << lane;
  }
  return hits;
}

//------------------------------------------------------------------------------
template <typename Visitor>
void RayTubeTree::Visit(const glm::dvec3& point, const glm::dvec3& padding, Visitor&& visit) const
{
  if (this->Nodes.empty())
  {
    return;
  }
  const Query query = this->MakeQuery(point, padding);

  struct Entry
  {
    std::int32_t Node;
    std::int32_t FirstFacet;
  };
  std::int32_t limit = NoFacet;
  std::array<Entry, StackSize> stack;
  std::size_t depth = 0;
  stack[depth++] = { 0, 0 };
  while (depth > 0)
  {
    const Entry entry = stack[--depth];
    if (entry.FirstFacet >= limit)
    {
      continue;
    }
    const Node& node = this->Nodes[static_cast<std::size_t>(entry.Node)];
    const unsigned hits = Overlaps(node, query);
    for (int child = Width - 1; child >= 0; --child)
    {
      if (!(hits >> child & 1u) || node.FirstFacet[child] >= limit)
      {
        continue;
      }
      if (node.Link[child] == NoNode)
      {
        limit = visit(node.FirstFacet[child]);
      }
      else
      {
        // Children are far apart in memory: those that wait on the stack are prefetched.
        Prefetch(&this->Nodes[static_cast<std::size_t>(node.Link[child])], sizeof(Node));
        stack[depth++] = { node.Link[child], node.FirstFacet[child] };
      }
    }
  }
}

}
