// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Tubes/BoxTree.h"

namespace meniscus
{
namespace
{

// A component of a direction that is zero counts as this: the ray leaves no box through the two
// faces beyond which it would have to go any distance.
constexpr double SmallestRate = 1e-300;

double Invert(double rate)
{
  return 1.0 / (std::fabs(rate) < SmallestRate ? std::copysign(SmallestRate, rate) : rate);
}

}

//------------------------------------------------------------------------------
TubeClip::TubeClip(const TubeBounds& tube)
  : Low(tube.StartLow)
  , High(tube.StartHigh)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->InverseLow[axis] = Invert(tube.DirectionLow[axis]);
    this->InverseHigh[axis] = Invert(tube.DirectionHigh[axis]);
  }
}

//------------------------------------------------------------------------------
void BoxTree::Build(const std::vector<AxisBox>& boxes)
{
  this->Nodes.clear();
  this->Nodes.reserve(2 * boxes.size());
  std::vector<std::int32_t> items(boxes.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    items[i] = static_cast<std::int32_t>(i);
  }
  if (!items.empty())
  {
    this->BuildNode(items.begin(), items.end(), boxes);
  }
}

//------------------------------------------------------------------------------
void BoxTree::BuildNode(std::vector<std::int32_t>::iterator begin,
  std::vector<std::int32_t>::iterator end, const std::vector<AxisBox>& boxes)
{
  const auto boxOf = [&boxes](std::int32_t item) -> const AxisBox&
  { return boxes[static_cast<std::size_t>(item)]; };
  const std::size_t index = this->Nodes.size();
  this->Nodes.push_back({ AxisBox(), NoItem, 0 });
  AxisBox whole;
  AxisBox middles;
  for (auto item = begin; item != end; ++item)
  {
    const AxisBox& box = boxOf(*item);
    const glm::dvec3 middle = 0.5 * box.Low + 0.5 * box.High;
    whole.Add(box);
    middles.Add({ middle, middle });
  }
  this->Nodes[index].Box = whole;
  if (end - begin == 1)
  {
    this->Nodes[index].Item = *begin;
    return;
  }
  const glm::dvec3 extent = middles.High - middles.Low;
  const int axis =
    extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const auto half = begin + (end - begin) / 2;
  // Equal places are ordered by number: the result must not depend on the library's selection.
  std::nth_element(begin, half, end,
    [&boxOf, axis](std::int32_t a, std::int32_t b)
    {
      const double first = boxOf(a).Low[axis] + boxOf(a).High[axis];
      const double second = boxOf(b).Low[axis] + boxOf(b).High[axis];
      return first != second ? first < second : a < b;
    });
  this->BuildNode(begin, half, boxes);
  this->Nodes[index].Right = static_cast<std::int32_t>(this->Nodes.size());
  this->BuildNode(half, end, boxes);
}

}
