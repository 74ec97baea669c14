// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Active cells of a TetrahedralMesh, and their boundary.
#include "Common/BlockLoop.h"
#include "Volume/Mesh/CellFaces.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/VisibleRanks.h"
#include "Volume/Optics/VisibleScalars.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

/** Contribution of a block of cells to the totals. */
struct BlockCount
{
  std::int64_t Active = 0;
  std::int64_t Changed = 0;
  std::int64_t Unknown = 0;
};

}

/** Whether a cell has scalars, and whether they can be seen. */
struct TetrahedralMesh::CellState
{
  bool IsKnown;
  bool IsSeen;
};

//------------------------------------------------------------------------------
bool TetrahedralMesh::UpdateActiveCells(
  const std::vector<float>& scalars, const VisibleScalars& visible, const RangeLoop& loop)
{
  const VisibleRanks seen(visible);
  if (this->ActiveCells == this->GetNumberOfCells() && seen.MeetsAll(scalars, loop))
  {
    this->UnknownCells = 0;
    return false;
  }
  const std::vector<VisibleRanks::Rank> ranks = seen.RanksOf(scalars, loop);
  return this->ActivateCells(
    [this, &seen, &ranks](std::size_t c)
    {
      const auto& v = this->Cells[c].Vertices;
      const VisibleRanks::Rank of[4] = { ranks[v[0]], ranks[v[1]], ranks[v[2]], ranks[v[3]] };
      const auto highest = std::max(std::max(of[0], of[1]), std::max(of[2], of[3]));
      const bool isKnown = highest != VisibleRanks::Unknown;
      return CellState{ isKnown,
        isKnown && seen.Meets(std::min(std::min(of[0], of[1]), std::min(of[2], of[3])), highest) };
    },
    loop);
}

//------------------------------------------------------------------------------
bool TetrahedralMesh::UpdateActiveCells(const std::vector<float>& cellScalars, CellJumps jumps,
  const VisibleScalars& visible, const RangeLoop& loop)
{
  return this->ActivateCells(
    [this, &cellScalars, jumps, &visible](std::size_t c)
    {
      float lowest = cellScalars[c];
      float highest = lowest;
      const bool isKnown = !std::isnan(lowest);
      for (const std::int32_t link : this->Cells[c].Links)
      {
        if (isKnown && jumps == CellJumps::Visible && link != NoNeighbor)
        {
          // fmin and fmax ignore a NaN: there is no jump to a cell without a value.
          const float across = cellScalars[(link < NoNeighbor ? MarkedLink(link) : link) / 4];
          lowest = std::fmin(lowest, across);
          highest = std::fmax(highest, across);
        }
      }
      return CellState{ isKnown, isKnown && visible.Meets(lowest, highest) };
    },
    loop);
}

//------------------------------------------------------------------------------
template <typename StateOf>
bool TetrahedralMesh::ActivateCells(StateOf&& stateOf, const RangeLoop& loop)
{
  std::vector<std::uint8_t> active(this->Cells.size());
  std::vector<BlockCount> counts(NumberOfBlocks(this->Cells.size()));
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      BlockCount count;
      for (std::size_t c = first; c < last; ++c)
      {
        const CellState state = stateOf(c);
        active[c] = state.IsSeen;
        count.Active += state.IsSeen;
        count.Unknown += !state.IsKnown;
        count.Changed += state.IsSeen != this->IsActive[c];
      }
      counts[block] = count;
    });
  BlockCount total;
  for (const BlockCount& count : counts)
  {
    total.Active += count.Active;
    total.Changed += count.Changed;
    total.Unknown += count.Unknown;
  }
  this->UnknownCells = total.Unknown;
  if (total.Changed == 0)
  {
    return false;
  }
  this->ActiveCells = total.Active;
  this->MarkLinks(active, loop);
  this->CollectBoundary(loop);
  return true;
}

//------------------------------------------------------------------------------
bool TetrahedralMesh::SetActiveCells(
  const std::vector<std::uint8_t>& active, std::int64_t unknown, const RangeLoop& loop)
{
  std::int64_t number = 0;
  bool changed = false;
  for (std::size_t c = 0; c < this->Cells.size(); ++c)
  {
    number += active[c];
    changed = changed || (active[c] != 0) != this->IsActive[c];
  }
  this->UnknownCells = unknown;
  if (changed)
  {
    this->ActiveCells = number;
    this->MarkLinks(active, loop);
    this->CollectBoundary(loop);
  }
  return changed;
}

//------------------------------------------------------------------------------
void TetrahedralMesh::MarkLinks(const std::vector<std::uint8_t>& active, const RangeLoop& loop)
{
  ForEachInBlocks(this->Cells.size(), loop,
    [this, &active](std::size_t c)
    {
      this->IsActive.Set(c, active[c] != 0);
      for (std::int32_t& link : this->Cells[c].Links)
      {
        if (link != NoNeighbor)
        {
          const std::int32_t neighbor = link < NoNeighbor ? MarkedLink(link) : link;
          link = active[neighbor / 4] ? neighbor : MarkedLink(neighbor);
        }
      }
    });
}

//------------------------------------------------------------------------------
BoundaryFace TetrahedralMesh::GetFace(std::int64_t cell, int face) const
{
  BoundaryFace made{ FaceVertices(this->Cells[cell].Vertices, face),
    static_cast<std::int32_t>(4 * cell + face) };
  this->Orient(made);
  return made;
}

//------------------------------------------------------------------------------
void TetrahedralMesh::Orient(BoundaryFace& face) const
{
  const bool isPositive = this->IsPositivelyOriented(face.CellFace / 4);
  const bool ascends = isPositive == (FaceParity(face.CellFace % 4) > 0);
  if (ascends != face.IsAscending())
  {
    std::swap(face.Vertices[0], face.Vertices[1]);
  }
}

//------------------------------------------------------------------------------
void TetrahedralMesh::CollectBoundary(const RangeLoop& loop)
{
  const auto isBoundary = [this](std::size_t c, int face)
  { return this->IsActive[c] && this->Cells[c].Links[face] < 0; };

  // Cells are counted before they are written, so that their order does not depend on the threads.
  std::vector<std::size_t> starts(NumberOfBlocks(this->Cells.size()) + 1, 0);
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        for (int face = 0; face < 4; ++face)
        {
          starts[block + 1] += isBoundary(c, face);
        }
      }
    });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  this->Boundary.resize(starts.back());
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      std::size_t next = starts[block];
      for (std::size_t c = first; c < last; ++c)
      {
        for (int face = 0; face < 4; ++face)
        {
          if (isBoundary(c, face))
          {
            this->Boundary[next++] = this->GetFace(static_cast<std::int64_t>(c), face);
          }
        }
      }
    });
}

}
