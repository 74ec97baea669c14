// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Positions of a TetrahedralMesh's vertices, and their motion.
#include "Common/BlockLoop.h"
#include "Volume/Mesh/ComponentVolume.h"
#include "Volume/Mesh/DuplicateCells.h"
#include "Volume/Mesh/PointBox.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

/** Squares of the lengths of a cell's edges, in units of positions. */
struct EdgeSquares
{
  double Longest = 0.0;
  double Shortest = std::numeric_limits<double>::infinity();
};

EdgeSquares MeasureEdges(
  const std::vector<glm::ivec3>& positions, const std::array<std::int32_t, 4>& vertices)
{
  EdgeSquares edges;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      const glm::dvec3 edge =
        glm::dvec3(positions[vertices[j]]) - glm::dvec3(positions[vertices[i]]);
      const double square = glm::dot(edge, edge);
      edges.Longest = std::max(edges.Longest, square);
      edges.Shortest = std::min(edges.Shortest, square);
    }
  }
  return edges;
}

/** Volume of the cells of one component that follow one another in the table. */
using ComponentRun = std::pair<std::int32_t, ComponentVolume>;

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
  this->MeasureCells(points, loop);
  return this->TurnComponents(loop);
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
  ForEachBlock(this->SourcePoints.size(), loop,
    [this, &points, scale](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t v = first; v < last; ++v)
      {
        this->Positions[v] = glm::round((points[this->SourcePoints[v]] - this->Center) * scale);
      }
    });
}

//------------------------------------------------------------------------------
void TetrahedralMesh::MeasureCells(const PointsView& points, const RangeLoop& loop)
{
  constexpr double limit = ShortestPreciseEdge / PositionUnit;
  std::vector<double> smallest(
    NumberOfBlocks(this->Cells.size()), std::numeric_limits<double>::infinity());
  std::vector<std::int64_t> imprecise(smallest.size(), 0);
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      double least = smallest[block];
      for (std::size_t c = first; c < last; ++c)
      {
        const EdgeSquares edges = MeasureEdges(this->Positions, this->Cells[c].Vertices);
        // Cells without volume are never crossed, so their size does not matter.
        if (edges.Longest < least && SignedVolume(this->Positions, this->Cells[c]) != 0.0)
        {
          least = edges.Longest;
        }
        imprecise[block] +=
          edges.Shortest < limit * limit && this->HasShortEdge(this->Cells[c], points);
      }
      smallest[block] = least;
    });
  const auto least = std::min_element(smallest.begin(), smallest.end());
  this->SmallestCell =
    least != smallest.end() && std::isfinite(*least) ? PositionUnit * std::sqrt(*least) : 1.0;
  this->ImpreciseCells = std::accumulate(imprecise.begin(), imprecise.end(), std::int64_t{ 0 });
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
/** Volume of each connected component. */
std::vector<ComponentVolume> TetrahedralMesh::MeasureComponents(const RangeLoop& loop) const
{
  std::vector<std::vector<ComponentRun>> runs(NumberOfBlocks(this->Cells.size()));
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      std::vector<ComponentRun>& ofBlock = runs[block];
      for (std::size_t c = first; c < last; ++c)
      {
        const std::int32_t component = this->ComponentOf(c);
        if (ofBlock.empty() || ofBlock.back().first != component)
        {
          ofBlock.emplace_back(component, ComponentVolume());
        }
        const double volume = SignedVolume(this->Positions, this->Cells[c]);
        ofBlock.back().second.Add(this->IsPositive[c] ? volume : -volume);
      }
    });
  std::vector<ComponentVolume> volumes(static_cast<std::size_t>(this->NumberOfComponents));
  for (const std::vector<ComponentRun>& ofBlock : runs)
  {
    for (const ComponentRun& run : ofBlock)
    {
      volumes[run.first].Add(run.second, 1);
    }
  }
  return volumes;
}

//------------------------------------------------------------------------------
/**
 * Makes the volume of every component positive again: the motion may have mirrored it. Returns
 * false if the volumes of a component cancel. A component without volume stays as it is.
 */
bool TetrahedralMesh::TurnComponents(const RangeLoop& loop)
{
  const std::vector<ComponentVolume> volumes = this->MeasureComponents(loop);
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
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        this->IsPositive.Set(c, this->IsPositive[c] != isMirrored(volumes[this->ComponentOf(c)]));
      }
    });
  for (BoundaryFace& face : this->Boundary)
  {
    const auto cell = static_cast<std::size_t>(face.CellFace) / 4;
    if (isMirrored(volumes[this->ComponentOf(cell)]))
    {
      std::swap(face.Vertices[0], face.Vertices[1]);
    }
  }
  return true;
}

}
