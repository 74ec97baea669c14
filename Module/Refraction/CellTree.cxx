// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/CellTree.h"

#include <glm/common.hpp>

#include <numeric>

namespace meniscus
{
namespace
{

using Iterator = std::vector<std::int32_t>::iterator;

// The smallest float that is not below the value. Conversion rounds to nearest, so one step up is
// enough; values beyond float become infinite, which bounds them as well.
float RoundUp(double value)
{
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) >= value
    ? rounded
    : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

// A rate of exactly zero would make 0 / 0 of a touching point; the next larger bound is as valid.
float RoundUpRate(double value)
{
  const float rounded = RoundUp(value);
  return std::fabs(rounded) < std::numeric_limits<float>::min() ? std::numeric_limits<float>::min()
                                                                : rounded;
}

Iterator SplitInHalf(Iterator begin, Iterator end, const std::vector<glm::dvec3>& centroids)
{
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (Iterator i = begin; i != end; ++i)
  {
    low = glm::min(low, centroids[static_cast<std::size_t>(*i)]);
    high = glm::max(high, centroids[static_cast<std::size_t>(*i)]);
  }
  const glm::dvec3 extent = high - low;
  const int axis =
    extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  const Iterator middle = begin + (end - begin) / 2;
  // Ties go by facet index: the topology depends on the facets alone, not on the library's sort.
  std::nth_element(begin, middle, end,
    [axis, &centroids](std::int32_t a, std::int32_t b)
    {
      const double first = centroids[static_cast<std::size_t>(a)][axis];
      const double second = centroids[static_cast<std::size_t>(b)][axis];
      return first != second ? first < second : a < b;
    });
  return middle;
}

}

//------------------------------------------------------------------------------
void TubeBounds::Add(const glm::dvec3& start, const glm::dvec3& direction)
{
  this->startLow = glm::min(this->startLow, start);
  this->startHigh = glm::max(this->startHigh, start);
  this->directionLow = glm::min(this->directionLow, direction);
  this->directionHigh = glm::max(this->directionHigh, direction);
}

//------------------------------------------------------------------------------
void CellTree::Build(const std::vector<glm::dvec3>& centroids, double unit)
{
  this->Scale = 1.0 / unit;
  this->Nodes.clear();
  this->Order.resize(centroids.size());
  std::iota(this->Order.begin(), this->Order.end(), 0);
  if (!this->Order.empty())
  {
    // A node of the bottom has two leaves at least, a node above four children: 2/3 per leaf at
    // most.
    this->Nodes.reserve(this->Order.size() + 1);
    this->BuildNode(this->Order.begin(), this->Order.end(), centroids);
    this->Nodes.shrink_to_fit();
  }
}

//------------------------------------------------------------------------------
std::int32_t CellTree::BuildNode(
  Iterator begin, Iterator end, const std::vector<glm::dvec3>& centroids)
{
  const std::size_t index = this->Nodes.size();
  this->Nodes.emplace_back();
  const Iterator middle =
    static_cast<std::size_t>(end - begin) > LeafSize ? SplitInHalf(begin, end, centroids) : end;
  const auto half = [&centroids](Iterator from, Iterator to) {
    return static_cast<std::size_t>(to - from) > LeafSize ? SplitInHalf(from, to, centroids) : to;
  };
  const std::array<Iterator, Width + 1> cut = { begin, half(begin, middle), middle,
    half(middle, end), end };
  for (std::size_t child = 0; child < Width; ++child)
  {
    const Iterator from = cut[child];
    const Iterator to = cut[child + 1];
    const auto count = static_cast<std::size_t>(to - from);
    std::int32_t link = -1;
    if (count > 0)
    {
      link = count > LeafSize ? this->BuildNode(from, to, centroids)
                              : static_cast<std::int32_t>(from - this->Order.begin());
    }
    Node& node = this->Nodes[index]; // only now: BuildNode may move the nodes
    node.link[child] = link;
    node.size[child] = static_cast<std::uint8_t>(count > LeafSize ? 0 : count);
    node.firstFacet[child] =
      count > 0 ? *std::min_element(from, to) : std::numeric_limits<std::int32_t>::max();
    ClearBounds(node, static_cast<int>(child));
  }
  return static_cast<std::int32_t>(index);
}

//------------------------------------------------------------------------------
void CellTree::Refit(const std::function<TubeBounds(std::int32_t)>& bounds, const RangeLoop& loop)
{
  loop(this->Nodes.size(),
    [this, &bounds](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        Node& node = this->Nodes[i];
        for (int child = 0; child < Width; ++child)
        {
          ClearBounds(node, child);
          TubeBounds merged;
          for (int k = 0; k < node.size[child]; ++k)
          {
            const TubeBounds facet =
              bounds(this->Order[static_cast<std::size_t>(node.link[child] + k)]);
            if (facet.IsValid())
            {
              merged.Add(facet.startLow, facet.directionLow);
              merged.Add(facet.startHigh, facet.directionHigh);
            }
          }
          this->StoreBounds(node, child, merged);
        }
      }
    });
  // Children come after their parents.
  for (std::size_t i = this->Nodes.size(); i-- > 0;)
  {
    Node& node = this->Nodes[i];
    for (int child = 0; child < Width; ++child)
    {
      if (node.size[child] == 0 && node.link[child] >= 0)
      {
        MergeChild(node, child, this->Nodes[static_cast<std::size_t>(node.link[child])]);
      }
    }
  }
}

//------------------------------------------------------------------------------
void CellTree::ClearBounds(Node& node, int child)
{
  // A start box turned inside out that leaves to the wrong side: no t is allowed. No component of a
  // unit direction is below -1, so merging this by maxima changes nothing.
  constexpr float outside = std::numeric_limits<float>::lowest() / 2.0f;
  for (int axis = 0; axis < 3; ++axis)
  {
    node.startHigh[axis][child] = outside;
    node.negatedStartLow[axis][child] = outside;
    node.directionHigh[axis][child] = -1.0f;
    node.negatedDirectionLow[axis][child] = -1.0f;
  }
}

//------------------------------------------------------------------------------
void CellTree::StoreBounds(Node& node, int child, const TubeBounds& bounds) const
{
  if (!bounds.IsValid())
  {
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    node.startHigh[axis][child] = RoundUp(bounds.startHigh[axis] * this->Scale);
    node.negatedStartLow[axis][child] = RoundUp(-bounds.startLow[axis] * this->Scale);
    node.directionHigh[axis][child] = RoundUpRate(bounds.directionHigh[axis]);
    node.negatedDirectionLow[axis][child] = RoundUpRate(-bounds.directionLow[axis]);
  }
}

//------------------------------------------------------------------------------
void CellTree::MergeChild(Node& node, int child, const Node& from)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto largest = [](const float(&lanes)[Width])
    { return *std::max_element(lanes, lanes + Width); };
    node.startHigh[axis][child] = largest(from.startHigh[axis]);
    node.negatedStartLow[axis][child] = largest(from.negatedStartLow[axis]);
    node.directionHigh[axis][child] = largest(from.directionHigh[axis]);
    node.negatedDirectionLow[axis][child] = largest(from.negatedDirectionLow[axis]);
  }
}

}
