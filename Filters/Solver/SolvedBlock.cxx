// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Solver/SolvedBlock.h"

#include "Common/CoherentOrder.h"
#include "Filters/Common/PointCoordinates.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace meniscus
{
namespace
{

// Compared bit by bit, so that a NaN equals itself.
bool SameValues(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}

//------------------------------------------------------------------------------
void SolvedBlock::UpdatePoints()
{
  if (this->SourceTime == this->Source->GetMTime())
  {
    return;
  }
  std::vector<double> values = CopyPoints(this->Source);
  if (!SameValues(values, this->Points))
  {
    this->Points = std::move(values);
    this->EyeUpdate = -1;
    this->StackUpdate = -1;
    this->OrderReady = false;
  }
  this->SourceTime = this->Source->GetMTime();
}

//------------------------------------------------------------------------------
void SolvedBlock::UpdateOrder(const RangeLoop& loop)
{
  if (!this->OrderReady)
  {
    this->Order = FindCoherentOrder(this->Points.data(), this->Points.size() / 3, loop);
    this->OrderReady = true;
  }
}

//------------------------------------------------------------------------------
bool SolvedBlock::IsSelected(std::size_t chunk) const
{
  const std::size_t first = chunk * ObjectImages::Chunk;
  if (this->Order.empty() || !this->Selection.IsActive)
  {
    return this->Selection.HasPoint(first);
  }
  const std::size_t last = std::min(first + ObjectImages::Chunk, this->Order.size());
  return std::any_of(this->Order.begin() + static_cast<std::ptrdiff_t>(first),
    this->Order.begin() + static_cast<std::ptrdiff_t>(last),
    [this](std::size_t point) { return this->Selection.HasPoint(point); });
}

//------------------------------------------------------------------------------
void SolvedBlock::ForgetImages()
{
  this->EyeUpdate = -1;
  this->StackUpdate = -1;
  this->All = false;
  this->Images.reset();
  this->ImagesOfStack.reset();
  this->Selection = ViewSelection();
}

//------------------------------------------------------------------------------
void SolvedBlock::UpdateTopology()
{
  if (this->TopologyTime == this->Source->GetMTime())
  {
    return;
  }
  ObjectTopology values = ExtractTopology(this->Source);
  if (!(values == this->Topology))
  {
    this->Topology = std::move(values);
    this->CellsReady = false;
    this->ViewChange = -1;
  }
  this->TopologyTime = this->Source->GetMTime();
}

}
