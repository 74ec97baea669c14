// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Tubes/RayTubeTree.h"

#include "Common/MedianSplit.h"

#include <glm/common.hpp>

#include <numeric>

namespace meniscus
{
namespace
{

using Iterator = std::vector<std::int32_t>::iterator;

// A rate that is not below the value: two units of the last place more than it, rounded once. A
// rate of exactly zero would give 0 / 0 for a point on the boundary; the next larger bound is also
// valid.
float RoundUpRate(double value)
{
  constexpr double unit = std::numeric_limits<float>::epsilon();
  const auto rounded = static_cast<float>(value + unit * std::fabs(value));
  return std::fabs(rounded) < std::numeric_limits<float>::min() ? std::numeric_limits<float>::min()
                                                                : rounded;
}

}

//------------------------------------------------------------------------------
void TubeBounds::Add(const glm::dvec3& start, const glm::dvec3& direction)
{
  this->Add({ start, start, direction, direction });
}

//------------------------------------------------------------------------------
void TubeBounds::Add(const TubeBounds& other)
{
  this->StartLow = glm::min(this->StartLow, other.StartLow);
  this->StartHigh = glm::max(this->StartHigh, other.StartHigh);
  this->DirectionLow = glm::min(this->DirectionLow, other.DirectionLow);
  this->DirectionHigh = glm::max(this->DirectionHigh, other.DirectionHigh);
}

//------------------------------------------------------------------------------
bool RayTubeTree::IsInReach(const glm::dvec3& point, double unit)
{
  const double reach = std::max({ std::fabs(point.x), std::fabs(point.y), std::fabs(point.z) });
  // The sum is tested so that a NaN fails: max() may ignore a NaN in one component, the sum does
  // not.
  return reach / unit < FarthestRadii && std::isfinite(point.x + point.y + point.z);
}

//------------------------------------------------------------------------------
void RayTubeTree::Build(const std::vector<glm::dvec3>& centroids, double unit)
{
  this->Scale = 1.0 / unit;
  this->Nodes.clear();
  std::vector<std::int32_t> order(centroids.size());
  std::iota(order.begin(), order.end(), 0);
  if (!order.empty())
  {
    // A bottom node has at least two leaves and an inner node four children: at most 2/3 of a node
    // per leaf.
    this->Nodes.reserve(order.size() + 1);
    this->BuildNode(order.begin(), order.end(), centroids);
    this->Nodes.shrink_to_fit();
  }
}

//------------------------------------------------------------------------------
std::int32_t RayTubeTree::BuildNode(
  Iterator begin, Iterator end, const std::vector<glm::dvec3>& centroids)
{
  const std::size_t index = this->Nodes.size();
  this->Nodes.emplace_back();
  const auto half = [&centroids](Iterator from, Iterator to)
  {
    return to - from > 1 ? SplitAtMedian(from, to,
                             [&centroids](std::int32_t item) -> const glm::dvec3&
                             { return centroids[static_cast<std::size_t>(item)]; })
                         : to;
  };
  const Iterator middle = half(begin, end);
  const std::array<Iterator, Width + 1> cut = { begin, half(begin, middle), middle,
    half(middle, end), end };
  for (std::size_t child = 0; child < Width; ++child)
  {
    const Iterator from = cut[child];
    const Iterator to = cut[child + 1];
    const std::int32_t link = to - from > 1 ? this->BuildNode(from, to, centroids) : NoNode;
    Node& node = this->Nodes[index]; // not earlier: BuildNode may move the nodes
    node.Link[child] = link;
    node.FirstFacet[child] = from != to ? *std::min_element(from, to) : NoFacet;
    ClearBounds(node, static_cast<int>(child));
  }
  return static_cast<std::int32_t>(index);
}

//------------------------------------------------------------------------------
void RayTubeTree::Refit(
  const std::function<TubeBounds(std::int32_t)>& bounds, const RangeLoop& loop)
{
  ForEachItem(this->Nodes.size(), loop,
    [this, &bounds](std::size_t i)
    {
      Node& node = this->Nodes[i];
      for (int child = 0; child < Width; ++child)
      {
        ClearBounds(node, child);
        if (node.Link[child] == NoNode && node.FirstFacet[child] != NoFacet)
        {
          this->StoreBounds(node, child, bounds(node.FirstFacet[child]));
        }
      }
    });
  // Children come after their parents, so a backward loop visits them first.
  for (std::size_t i = this->Nodes.size(); i-- > 0;)
  {
    Node& node = this->Nodes[i];
    for (int child = 0; child < Width; ++child)
    {
      if (node.Link[child] != NoNode)
      {
        MergeChild(node, child, this->Nodes[static_cast<std::size_t>(node.Link[child])]);
      }
    }
  }
}

//------------------------------------------------------------------------------
void RayTubeTree::ClearBounds(Node& node, int child)
{
  // An inverted start box, with rates of the wrong sign, allows no t. No component of a unit
  // direction is below -1, so merging this with other bounds by maxima does not change them.
  constexpr float outside = std::numeric_limits<float>::lowest() / 2.0f;
  for (int side = 0; side < Sides; ++side)
  {
    node.Start[side][child] = outside;
    node.Direction[side][child] = -1.0f;
  }
}

//------------------------------------------------------------------------------
void RayTubeTree::StoreBounds(Node& node, int child, const TubeBounds& bounds) const
{
  if (!bounds.IsValid())
  {
    return;
  }
  const auto store = [this, &node, child](int side, double start, double rate)
  {
    const double place = start * this->Scale;
    node.Start[side][child] = static_cast<float>(place + Rounding * std::fabs(place));
    node.Direction[side][child] = RoundUpRate(rate);
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    store(axis, bounds.StartHigh[axis], bounds.DirectionHigh[axis]);
    store(axis + 3, -bounds.StartLow[axis], -bounds.DirectionLow[axis]);
  }
}

//------------------------------------------------------------------------------
void RayTubeTree::MergeChild(Node& node, int child, const Node& from)
{
  const auto largest = [](const float(&lanes)[Width])
  { return std::max(std::max(lanes[0], lanes[1]), std::max(lanes[2], lanes[3])); };
  for (int side = 0; side < Sides; ++side)
  {
    node.Start[side][child] = largest(from.Start[side]);
    node.Direction[side][child] = largest(from.Direction[side]);
  }
}

}
