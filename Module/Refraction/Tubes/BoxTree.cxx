// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Tubes/BoxTree.h"

#include "Common/MedianSplit.h"

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
  for (auto item = begin; item != end; ++item)
  {
    this->Nodes[index].Box.Add(boxOf(*item));
  }
  if (end - begin == 1)
  {
    this->Nodes[index].Item = *begin;
    return;
  }
  const auto half = SplitAtMedian(begin, end,
    [&boxOf](std::int32_t item) { return 0.5 * boxOf(item).Low + 0.5 * boxOf(item).High; });
  this->BuildNode(begin, half, boxes);
  this->Nodes[index].Right = static_cast<std::int32_t>(this->Nodes.size());
  this->BuildNode(half, end, boxes);
}

}
