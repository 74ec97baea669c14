// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Solver/SolvedBlock.h"

#include <cstring>
#include <utility>

namespace meniscus
{
namespace
{

std::vector<double> CopyPoints(vtkPolyData* input)
{
  const vtkIdType count = input->GetNumberOfPoints();
  std::vector<double> points(3 * static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    input->GetPoint(i, points.data() + 3 * i);
  }
  return points;
}

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
  }
  this->SourceTime = this->Source->GetMTime();
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
