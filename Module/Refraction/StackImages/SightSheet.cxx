// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/SightSheetBuilder.h"

#include <glm/common.hpp>

#include <algorithm>

namespace meniscus
{
namespace
{

// Cells of which some rays do not pass are divided down to this level, counted from cells that are
// no wider than their distance from the eye, where interval arithmetic allows for other rays
// between them.
constexpr int DeepestBlind = 5;

// Cells of a patch. A patch with borders and critical angles usually has a thousand. In a long
// facet that is near the eye and as wide as the view they are slender: up to 350,000 in random
// scenes.
constexpr std::size_t MostCells = 1 << 19;

}

//------------------------------------------------------------------------------
void SightSheet::Builder::Run()
{
  Cell whole;
  whole.Nodes = { this->Add({ 0.0, 0.0 }), this->Add({ 1.0, 0.0 }), this->Add({ 0.0, 1.0 }) };
  this->Result.Cells.push_back(whole);
  this->Divide(0, 0);
  if (this->Result.Cells.size() > MostCells)
  {
    this->Sheet.Solver.CountUndecided(); // cells that are left whole may hide an image
  }
  this->BoundCells();
}

//------------------------------------------------------------------------------
// True if a ray between the corners may pass more interfaces than those of a corner.
bool SightSheet::Builder::MayPassMore(const Cell& cell, int depth) const
{
  const int least = std::min({ this->Get(cell.Nodes[0]).Legs, this->Get(cell.Nodes[1]).Legs,
    this->Get(cell.Nodes[2]).Legs });
  if (least >= this->Links || depth >= DeepestBlind)
  {
    return false;
  }
  const PatchTriangle corners{ this->Get(cell.Nodes[0]).B, this->Get(cell.Nodes[1]).B,
    this->Get(cell.Nodes[2]).B };
  // A leg is seen where rays meet the surface at its end; the last one where they pass.
  const auto next = static_cast<std::size_t>(least + 1);
  return next < this->Sheet.Links
    ? MayMeet(this->Stack, this->Facet, corners, next)
    : this->Sheet.Solver.GetBeams().MayPass(this->Facet, corners, next);
}

//------------------------------------------------------------------------------
void SightSheet::Builder::Divide(std::size_t index, int depth)
{
  if (this->Result.Cells.size() > MostCells)
  {
    return;
  }
  const Cell cell = this->Result.Cells[index];
  std::array<std::int32_t, 3> middle{ NotSplit, NotSplit, NotSplit }; // opposite the corners
  int count = 0;
  for (std::size_t k = 0; k < 3 && depth < DeepestCell; ++k)
  {
    middle[k] = this->Split(cell.Nodes[(k + 1) % 3], cell.Nodes[(k + 2) % 3]);
    count += middle[k] != NotSplit;
  }
  const std::int32_t corner =
    count == 0 && depth < DeepestCell ? this->AddCorner(cell.Nodes) : NotSplit;
  if (corner != NotSplit)
  {
    const std::array<std::int32_t, 3>& n = cell.Nodes;
    this->AddChildren(
      index, { { n[0], n[1], corner }, { n[1], n[2], corner }, { n[2], n[0], corner } }, depth);
    return;
  }
  if (count == 0 && this->MayPassMore(cell, depth))
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      middle[k] = this->Add(
        0.5 * (this->Get(cell.Nodes[(k + 1) % 3]).B + this->Get(cell.Nodes[(k + 2) % 3]).B));
    }
    count = 3;
  }
  if (count > 0)
  {
    // Divisions of wide cells do not count.
    const bool isWide = this->IsWide(cell.Nodes[0], cell.Nodes[1]) ||
      this->IsWide(cell.Nodes[1], cell.Nodes[2]) || this->IsWide(cell.Nodes[2], cell.Nodes[0]);
    const std::array<bool, 3> isDivided{ middle[0] != NotSplit, middle[1] != NotSplit,
      middle[2] != NotSplit };
    Triangles children;
    VisitParts(cell.Nodes, middle, isDivided,
      [&children](const std::array<std::int32_t, 3>& part) { children.push_back(part); });
    this->AddChildren(index, children, isWide ? depth - 1 : depth);
  }
}

//------------------------------------------------------------------------------
void SightSheet::Builder::AddChildren(std::size_t index, const Triangles& children, int depth)
{
  const std::size_t first = this->Result.Cells.size();
  this->Result.Cells[index].FirstChild = static_cast<std::int32_t>(first);
  this->Result.Cells[index].Children = static_cast<std::int32_t>(children.size());
  for (const std::array<std::int32_t, 3>& child : children)
  {
    Cell part;
    part.Nodes = child;
    this->Result.Cells.push_back(part);
  }
  for (std::size_t c = 0; c < children.size(); ++c)
  {
    this->Divide(first + c, depth + 1);
  }
}

//------------------------------------------------------------------------------
// Adds the bounds of a cell's rays on a leg, and those of their ends, with as much again on all
// sides: cells are clipped by interpolated moments of the rays, which differ from those of
// interpolated rays.
void SightSheet::Builder::BoundCell(
  const LegCell& cell, bool isLast, TubeBounds& rays, AxisBox& ends) const
{
  TubeBounds tube;
  AxisBox end;
  for (std::size_t k = 0; k < 3; ++k)
  {
    tube.Add(cell.Nodes[k].From.At.Position, cell.Nodes[k].From.Ray);
    end.Add({ tube.StartLow, tube.StartHigh });
    if (!isLast)
    {
      end.Add({ cell.Ends[k], cell.Ends[k] });
    }
  }
  const glm::dvec3 wide = tube.StartHigh - tube.StartLow;
  const glm::dvec3 turn = tube.DirectionHigh - tube.DirectionLow;
  rays.Add(tube.StartLow - wide, tube.DirectionLow - turn);
  rays.Add(tube.StartHigh + wide, tube.DirectionHigh + turn);
  const glm::dvec3 far = end.High - end.Low;
  ends.Add({ end.Low - far, end.High + far });
}

//------------------------------------------------------------------------------
// Children come behind their parents.
void SightSheet::Builder::BoundCells()
{
  const std::size_t legs = this->Sheet.Links + 1;
  std::vector<TubeBounds> bounds(this->Result.Cells.size() * legs);
  this->Result.Boxes.resize(legs);
  LegCell part;
  for (std::size_t i = this->Result.Cells.size(); i-- > 0;)
  {
    const Cell& cell = this->Result.Cells[i];
    for (std::size_t leg = 0; leg < legs; ++leg)
    {
      TubeBounds& own = bounds[i * legs + leg];
      if (cell.Children == 0 && this->Sheet.GetLeg(this->Result, cell, leg, part))
      {
        this->BoundCell(part, leg + 1 == legs, own, this->Result.Boxes[leg]);
      }
      for (std::int32_t k = 0; k < cell.Children; ++k)
      {
        own.Add(bounds[static_cast<std::size_t>(cell.FirstChild + k) * legs + leg]);
      }
    }
  }
  this->Result.Tubes = std::vector<TubeClip>(bounds.begin(), bounds.end());
}

//------------------------------------------------------------------------------
SightSheet::SightSheet(const StackSolver& solver, double tolerance, double farthest)
  : Solver(solver)
  , Tolerance(tolerance)
  , Farthest(farthest)
  , Links(solver.GetStack().GetLinks().size())
  , Borders(solver)
{
  const std::size_t facets = this->Links == 0
    ? 0
    : solver.GetStack().GetLinks()[0].Surface->GetMembrane().GetFacets().size();
  this->Patches.resize(facets);
  this->Once = std::make_unique<std::once_flag[]>(facets);
}

//------------------------------------------------------------------------------
SightSheet::~SightSheet() = default;

//------------------------------------------------------------------------------
const SightSheet::Patch& SightSheet::GetPatch(std::int32_t facet) const
{
  const auto i = static_cast<std::size_t>(facet);
  std::call_once(this->Once[i],
    [this, facet, i]
    {
      this->Patches[i] = std::make_unique<Patch>();
      Builder(*this, facet, *this->Patches[i]).Run();
    });
  return *this->Patches[i];
}

//------------------------------------------------------------------------------
bool SightSheet::MayShow(
  const Patch& patch, std::size_t cell, std::size_t leg, const AxisBox& box) const
{
  const TubeRange range =
    patch.Tubes[cell * (this->Links + 1) + leg].Clip(box, std::numeric_limits<double>::max());
  return range.From <= range.To;
}

//------------------------------------------------------------------------------
const CurvedPatch& SightSheet::GetSurface(const Patch& patch)
{
  return patch.Surface;
}

//------------------------------------------------------------------------------
// Returns false if the leg is not seen at all corners.
bool SightSheet::GetLeg(
  const Patch& patch, const Cell& cell, std::size_t leg, LegCell& result) const
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto index = static_cast<std::size_t>(cell.Nodes[k]);
    const Node& node = patch.Nodes[index];
    if (node.Legs < static_cast<int>(leg) || (leg == 0 && !node.IsFirst))
    {
      return false;
    }
    const std::size_t ray = index * (this->Links + 1) + leg;
    result.Nodes[k] = { node.B,
      { { patch.Points[ray], glm::dvec3(0.0) }, patch.Directions[ray], true } };
    if (leg < this->Links)
    {
      result.Ends[k] = patch.Points[ray + 1];
    }
  }
  return true;
}

}
