// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Positions of a TetrahedralMesh's vertices, and their motion.
#include "Common/BlockLoop.h"
#include "Volume/Mesh/CellMeasures.h"
#include "Volume/Mesh/ComponentVolume.h"
#include "Volume/Mesh/DuplicateCells.h"
#include "Volume/Mesh/PointBox.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

/** std::round() of a number below 2^31, without a call. */
std::int32_t Rounded(double number)
{
  const auto whole = static_cast<std::int32_t>(number);
  const double rest = number - whole; // exact
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

/** Volume of the cells of one component that follow one another in the table. */
using ComponentRun = std::pair<std::int32_t, ComponentVolume>;

/** Contribution of a block of cells to the measures of a mesh. */
struct BlockMeasure
{
  double SmallestSquare = std::numeric_limits<double>::infinity();
  double LargestSquare = 0.0;
  std::int64_t Imprecise = 0;
  std::vector<ComponentRun> Runs;
};

}

//------------------------------------------------------------------------------
bool TetrahedralMesh::MovePoints(const PointsView& points, const RangeLoop& loop)
{
  if (!this->IsMovable || !this->MeasurePoints(points, loop))
  {
    return false;
  }
  if (!this->Coincident.empty() && this->FindCoincident(points, loop) != this->Coincident)
  {
    return false;
  }
  this->RoundPositions(points, loop);
  std::vector<ComponentVolume> volumes(static_cast<std::size_t>(this->NumberOfComponents));
  this->MeasureCells(points, loop, &volumes);
  return this->TurnComponents(volumes, loop);
}

//------------------------------------------------------------------------------
/** Takes centre and radius from the points of the vertices. Returns false if one is not finite. */
bool TetrahedralMesh::MeasurePoints(const PointsView& points, const RangeLoop& loop)
{
  const std::size_t size = this->SourcePoints.size();
  std::vector<PointBox> boxes(NumberOfBlocks(size));
  std::vector<std::uint8_t> finite(boxes.size(), 1);
  ForEachBlock(size, loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      PointBox box;
      bool allFinite = true;
      for (std::size_t v = first; v < last; ++v)
      {
        const glm::dvec3 point = points[this->SourcePoints[v]];
        allFinite = allFinite && IsFinite(point);
        box.Add(point);
      }
      boxes[block] = box;
      finite[block] = allFinite;
    });
  if (std::find(finite.begin(), finite.end(), 0) != finite.end())
  {
    return false;
  }
  const PointBox all = Enclose(boxes);
  this->Center = all.GetCenter();
  this->HalfSize = all.GetHalfSize();
  std::vector<double> radii(boxes.size(), 0.0);
  ForEachBlock(size, loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t v = first; v < last; ++v)
      {
        radii[block] =
          std::max(radii[block], glm::length(points[this->SourcePoints[v]] - this->Center));
      }
    });
  this->Radius = *std::max_element(radii.begin(), radii.end());
  return true;
}

//------------------------------------------------------------------------------
/** Places the vertices at their points, in fixed point about centre and radius. */
void TetrahedralMesh::RoundPositions(const PointsView& points, const RangeLoop& loop)
{
  const double scale = this->Radius > 0.0 ? 1.0 / PositionUnit / this->Radius : 0.0;
  ForEachInBlocks(this->SourcePoints.size(), loop,
    [this, &points, scale](std::size_t v)
    {
      const glm::dvec3 place = (points[this->SourcePoints[v]] - this->Center) * scale;
      this->Positions[v] = { Rounded(place.x), Rounded(place.y), Rounded(place.z) };
    });
}

//------------------------------------------------------------------------------
/** @param volumes sums for each component, to which the cells are added; null for none. */
void TetrahedralMesh::MeasureCells(
  const PointsView& points, const RangeLoop& loop, std::vector<ComponentVolume>* volumes)
{
  constexpr double limit = ShortestPreciseEdge / PositionUnit;
  const InstructionSet set = BestInstructionSet();
  std::vector<BlockMeasure> blocks(NumberOfBlocks(this->Cells.size()));
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      BlockMeasure measure;
      CellMeasures lanes;
      ForEachGroup(*this, first, last, lanes,
        [&](CellMeasures& cells, std::size_t begin)
        {
          MeasureLanes(set, cells);
          for (int i = 0; i < cells.Count; ++i)
          {
            const std::size_t c = begin + static_cast<std::size_t>(i);
            // Cells without volume are never crossed, so their size does not matter.
            if (cells.Longest[i] < measure.SmallestSquare && cells.Volumes[i] != 0.0)
            {
              measure.SmallestSquare = cells.Longest[i];
            }
            measure.LargestSquare = std::max(measure.LargestSquare, cells.Longest[i]);
            measure.Imprecise +=
              cells.Shortest[i] < limit * limit && this->HasShortEdge(this->Cells[c], points);
          }
          if (volumes)
          {
            this->AddVolumes(cells, begin, measure.Runs);
          }
        });
      blocks[block] = std::move(measure);
    });
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  this->ImpreciseCells = 0;
  for (const BlockMeasure& block : blocks)
  {
    least = std::min(least, block.SmallestSquare);
    most = std::max(most, block.LargestSquare);
    this->ImpreciseCells += block.Imprecise;
    for (const ComponentRun& run : block.Runs)
    {
      (*volumes)[static_cast<std::size_t>(run.first)].Add(run.second, 1);
    }
  }
  this->SmallestCell = std::isfinite(least) ? PositionUnit * std::sqrt(least) : 1.0;
  this->LongestEdge = PositionUnit * std::sqrt(most);
}

//------------------------------------------------------------------------------
/** Adds the volumes of measured cells to the volumes of the cells before them. */
void TetrahedralMesh::AddVolumes(const CellMeasures& cells, std::size_t first,
  std::vector<std::pair<std::int32_t, ComponentVolume>>& runs) const
{
  // A table, since no branch predicts the orientations.
  static constexpr double signs[2] = { -1.0, 1.0 };
  std::int32_t component = this->ComponentOf(first);
  ComponentVolume sum;
  if (!runs.empty() && runs.back().first == component)
  {
    sum = runs.back().second;
    runs.pop_back();
  }
  for (int i = 0; i < cells.Count; ++i)
  {
    const std::size_t c = first + static_cast<std::size_t>(i);
    if (this->ComponentOf(c) != component)
    {
      runs.push_back(ComponentRun(component, sum));
      component = this->ComponentOf(c);
      sum = ComponentVolume();
    }
    sum.Add(signs[this->IsPositive[c] ? 1 : 0] * cells.Volumes[i]);
  }
  runs.push_back(ComponentRun(component, sum));
}

//------------------------------------------------------------------------------
/** True if an edge between different points is shorter than ShortestPreciseEdge. */
bool TetrahedralMesh::HasShortEdge(const Cell& cell, const PointsView& points) const
{
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec3 p = points[this->SourcePoints[cell.Vertices[i]]];
    for (int j = i + 1; j < 4; ++j)
    {
      const double length = glm::length(points[this->SourcePoints[cell.Vertices[j]]] - p);
      if (length > 0.0 && length < ShortestPreciseEdge * this->Radius)
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/** Lowest vertex at the position of each vertex. */
std::vector<std::int32_t> TetrahedralMesh::FindCoincident(
  const PointsView& points, const RangeLoop& loop) const
{
  return FindLowestCoincident(
    this->SourcePoints.size(), [&](std::size_t v) { return points[this->SourcePoints[v]]; }, loop);
}

//------------------------------------------------------------------------------
/**
 * Makes the volume of every component positive again: the motion may have mirrored it. Returns
 * false if the volumes of a component cancel. A component without volume stays as it is.
 */
bool TetrahedralMesh::TurnComponents(
  const std::vector<ComponentVolume>& volumes, const RangeLoop& loop)
{
  // Sums in another order differ by less than NegligibleVolume, so that Build() finds no volumes
  // that cancel beyond twice that.
  if (std::any_of(volumes.begin(), volumes.end(),
        [](const ComponentVolume& volume) { return volume.Cancels(2.0 * NegligibleVolume); }))
  {
    return false;
  }
  const auto isMirrored = [](const ComponentVolume& volume) { return volume.Sum < 0.0; };
  if (std::none_of(volumes.begin(), volumes.end(), isMirrored))
  {
    return true;
  }
  ForEachInBlocks(this->Cells.size(), loop,
    [&](std::size_t c)
    { this->IsPositive.Set(c, this->IsPositive[c] != isMirrored(volumes[this->ComponentOf(c)])); });
  for (BoundaryFace& face : this->Boundary)
  {
    this->Orient(face);
  }
  return true;
}

}
