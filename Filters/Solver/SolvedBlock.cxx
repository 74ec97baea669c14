// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Solver/SolvedBlock.h"

#include "Common/CoherentOrder.h"
#include "Filters/Common/PointCoordinates.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Refraction/Images/ObjectImages.h"
#include "Refraction/StackImages/StackImages.h"

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
    this->Rays = -1;
    this->OrderReady = false;
  }
  this->SourceTime = this->Source->GetMTime();
}

//------------------------------------------------------------------------------
void SolvedBlock::PrepareFirst(const RefractionScene& scene)
{
  const std::size_t count = this->Points.size() / 3;
  if (const StackSolver* list = scene.GetPathSolver())
  {
    this->Order.clear();
    this->OrderReady = false;
    this->Stack.Points.assign(count, StackDetail());
    this->Stack.Interfaces = list->GetStack().GetNumberOfInterfaces();
    this->Stack.Legs.assign(count * this->Stack.Interfaces, 0.0);
  }
  else if (!this->OrderReady)
  {
    this->Order = FindCoherentOrder(this->Points.data(), count, ThreadedLoop);
    this->OrderReady = true;
  }
}

//------------------------------------------------------------------------------
std::unique_ptr<CellImages> SolvedBlock::MakeImages(
  CurvedMembraneSolver& solver, const ParallelPlanes* plane) const
{
  const std::size_t count = this->Points.size() / 3;
  const bool mayCross = !solver.AreAllOnRaySide(this->Points.data(), count);
  if (mayCross)
  {
    solver.PrepareSides();
    solver.PrepareTree(FacetLoop);
  }
  auto images = std::make_unique<ObjectImages>(solver, plane);
  images->SetPoints(this->Points.data(), count, mayCross);
  solver.PrepareField();
  images->PrepareUnique(
    count, this->Topology.Lines.GetCount() + this->Topology.Polygons.GetCount(), FacetLoop);
  return images;
}

//------------------------------------------------------------------------------
void SolvedBlock::MakeImages(RefractionScene& scene)
{
  this->All = true;
  this->Vertices.clear();
  if (const StackSolver* list = scene.GetPathSolver())
  {
    auto images = std::make_unique<StackImages>(*list);
    images->SetPoints(this->Points.data(), this->Points.size() / 3);
    this->Images = std::move(images);
  }
  else
  {
    this->Images = this->MakeImages(scene.GetCurved(), scene.GetPlane());
  }
}

//------------------------------------------------------------------------------
void SolvedBlock::PrepareCells(RefractionScene& scene) const
{
  const std::size_t count = this->Points.size() / 3;
  for (std::size_t i = 0; i < count && !scene.GetPathSolver(); ++i)
  {
    if (this->Images->GetNumberOfImages(i) != 1)
    {
      scene.GetCurved().PrepareTree(FacetLoop);
      return;
    }
  }
}

//------------------------------------------------------------------------------
const StackImages& SolvedBlock::GetStackImages() const
{
  return static_cast<const StackImages&>(*this->Images);
}

//------------------------------------------------------------------------------
bool SolvedBlock::IsSelected(std::size_t chunk) const
{
  const std::size_t first = chunk * CellImages::Chunk;
  if (this->Order.empty() || !this->Selection.IsActive)
  {
    return this->Selection.HasPoint(first);
  }
  const std::size_t last = std::min(first + CellImages::Chunk, this->Order.size());
  return std::any_of(this->Order.begin() + static_cast<std::ptrdiff_t>(first),
    this->Order.begin() + static_cast<std::ptrdiff_t>(last),
    [this](std::size_t point) { return this->Selection.HasPoint(point); });
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
