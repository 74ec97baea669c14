// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/TetrahedralMesh.h"

#include "Common/BlockLoop.h"
#include "Common/MortonOrder.h"
#include "Volume/Mesh/DuplicateCells.h"
#include "Volume/Mesh/PointBox.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <utility>

namespace meniscus
{
namespace
{

/** Sorts four values without branches, which no branch predictor would foresee. */
void SortFour(std::array<std::int32_t, 4>& values)
{
  constexpr int pairs[5][2] = { { 0, 1 }, { 2, 3 }, { 0, 2 }, { 1, 3 }, { 1, 2 } };
  for (const auto& pair : pairs)
  {
    const std::int32_t low = std::min(values[pair[0]], values[pair[1]]);
    values[pair[1]] = std::max(values[pair[0]], values[pair[1]]);
    values[pair[0]] = low;
  }
}

/** Resizes a table. Its memory is reused unless it is far too large. */
template <typename T>
void ResizeTable(std::vector<T>& table, std::size_t size)
{
  if (table.capacity() / 2 > size)
  {
    table = std::vector<T>();
  }
  table.resize(size);
}

/** Replaces the counts of blocks by the start of each block's part; returns the sum. */
std::size_t CountsToStarts(std::vector<std::size_t>& counts)
{
  std::size_t next = 0;
  for (std::size_t& count : counts)
  {
    next += std::exchange(count, next);
  }
  return next;
}

}

/** Tables that are needed only while the mesh is built. */
class TetrahedralMesh::Builder
{
public:
  Builder(TetrahedralMesh& mesh, const TetrahedraView& input, const RangeLoop& loop)
    : Mesh(mesh)
    , Input(input)
    , Loop(loop)
    , CellStarts(NumberOfBlocks(input.NumberOfCells))
    , Used(new std::atomic<std::uint8_t>[input.NumberOfPoints])
  {
  }

  bool HasCells() const { return this->NumberOfCells > 0; }

  void ValidateCells();
  void NumberVertices();
  void NumberCells();

private:
  using Quad = std::array<std::int32_t, 4>;

  template <typename Id>
  void ReadBlock(const Id* cells, std::size_t first, std::size_t last, RejectedCells& rejected,
    std::size_t& accepted);
  std::vector<MortonKey> KeysOfUsedPoints();
  void TakeCodesOfCells(const MortonCurve& curve, std::vector<MortonKey>& keys);
  void RemoveDuplicates(const std::vector<MortonKey>& keys);

  TetrahedralMesh& Mesh;
  const TetrahedraView& Input;
  const RangeLoop& Loop;
  /**
   * Points, and later the vertices in ascending order, of each input cell; the first is -1 if the
   * cell is rejected. They are stored in the memory of the links, which are filled later: touching
   * new memory for the first time costs more than most of the work here.
   */
  Quad& CornersOf(std::size_t inputCell) { return this->Mesh.Cells[inputCell].Links; }
  /** Number of accepted cells in the blocks before each block of input cells. */
  std::vector<std::size_t> CellStarts;
  std::size_t NumberOfCells = 0;
  std::vector<std::uint8_t> Finite;
  std::unique_ptr<std::atomic<std::uint8_t>[]> Used;
  std::vector<std::int32_t> VertexOfPoint;
};

//------------------------------------------------------------------------------
void TetrahedralMesh::Clear()
{
  *this = TetrahedralMesh();
}

//------------------------------------------------------------------------------
void TetrahedralMesh::ForgetAllButTables()
{
  this->Components.clear();
  this->NumberOfComponents = 0;
  this->Coincident.clear();
  this->IsMovable = false;
  this->Rejected = RejectedCells();
  this->CutLinks = 0;
  this->ActiveCells = 0;
  this->UnknownCells = 0;
  this->Center = glm::dvec3(0.0);
  this->HalfSize = glm::dvec3(0.0);
  this->Radius = 0.0;
  this->SmallestCell = 1.0;
  this->LongestEdge = 0.0;
  this->ImpreciseCells = 0;
}

//------------------------------------------------------------------------------
MeshStatus TetrahedralMesh::Build(const TetrahedraView& input, const MeshBuildControl& control)
{
  // A vertex index has 31 bits, and so has a link.
  if (input.NumberOfCells > MaximumNumberOfCells ||
    input.NumberOfPoints > std::numeric_limits<std::int32_t>::max())
  {
    this->Clear();
    return MeshStatus::TooLarge;
  }
  this->ForgetAllButTables();
  const auto goesOn = [this, &control](double fraction)
  {
    const bool on = !control.Progress || control.Progress(fraction);
    if (!on)
    {
      this->Clear();
    }
    return on;
  };
  auto builder = std::make_unique<Builder>(*this, input, control.Loop);
  builder->ValidateCells();
  if (!builder->HasCells())
  {
    const RejectedCells rejected = this->Rejected;
    this->Clear();
    this->Rejected = rejected;
    return MeshStatus::Empty;
  }
  // Fractions of the time, measured for meshes of 200 thousand cells.
  if (!goesOn(0.1))
  {
    return MeshStatus::Aborted;
  }
  builder->NumberVertices();
  if (!goesOn(0.2))
  {
    return MeshStatus::Aborted;
  }
  builder->NumberCells();
  builder.reset();
  if (!goesOn(0.5))
  {
    return MeshStatus::Aborted;
  }
  this->LinkCells(control.Loop);
  if (!goesOn(0.8))
  {
    return MeshStatus::Aborted;
  }
  this->IsMovable = this->Radius > 0.0 && this->Rejected.PointNotFinite == 0;
  this->MeasureCells(input.Points, control.Loop);
  this->OrientCells(control.Loop);
  this->ActiveCells = this->GetNumberOfCells();
  this->IsActive.Assign(this->Cells.size(), true);
  this->CollectBoundary(control.Loop);
  return MeshStatus::Ok;
}

//------------------------------------------------------------------------------
void TetrahedralMesh::Builder::ValidateCells()
{
  const auto numberOfPoints = static_cast<std::size_t>(this->Input.NumberOfPoints);
  ResizeTable(this->Mesh.Cells, static_cast<std::size_t>(this->Input.NumberOfCells));
  this->Finite.resize(numberOfPoints);
  ForEachInBlocks(numberOfPoints, this->Loop,
    [this](std::size_t p)
    {
      this->Finite[p] = IsFinite(this->Input.Points[p]);
      this->Used[p].store(0, std::memory_order_relaxed);
    });
  std::vector<RejectedCells> rejected(this->CellStarts.size());
  ForEachBlock(this->Input.NumberOfCells, this->Loop,
    [this, &rejected](std::size_t block, std::size_t first, std::size_t last)
    {
      if (this->Input.ShortCells)
      {
        this->ReadBlock(
          this->Input.ShortCells, first, last, rejected[block], this->CellStarts[block]);
      }
      else
      {
        this->ReadBlock(this->Input.Cells, first, last, rejected[block], this->CellStarts[block]);
      }
    });
  for (const RejectedCells& part : rejected)
  {
    this->Mesh.Rejected.IndexOutOfRange += part.IndexOutOfRange;
    this->Mesh.Rejected.RepeatedVertex += part.RepeatedVertex;
    this->Mesh.Rejected.PointNotFinite += part.PointNotFinite;
  }
  this->NumberOfCells = CountsToStarts(this->CellStarts);
}

//------------------------------------------------------------------------------
template <typename Id>
void TetrahedralMesh::Builder::ReadBlock(const Id* cells, std::size_t first, std::size_t last,
  RejectedCells& rejected, std::size_t& accepted)
{
  const std::uint8_t* flags = this->Input.CellFlags;
  for (std::size_t c = first; c < last; ++c)
  {
    const Id* ids = cells + 4 * c;
    Quad& corners = this->CornersOf(c);
    corners[0] = -1;
    if (flags && (flags[c] & this->Input.LeftOutBits))
    {
      continue;
    }
    const auto inRange = [this](Id id) { return id >= 0 && id < this->Input.NumberOfPoints; };
    if (!(inRange(ids[0]) && inRange(ids[1]) && inRange(ids[2]) && inRange(ids[3])))
    {
      ++rejected.IndexOutOfRange;
    }
    else if (ids[0] == ids[1] || ids[0] == ids[2] || ids[0] == ids[3] || ids[1] == ids[2] ||
      ids[1] == ids[3] || ids[2] == ids[3])
    {
      ++rejected.RepeatedVertex;
    }
    else if (!(this->Finite[ids[0]] && this->Finite[ids[1]] && this->Finite[ids[2]] &&
               this->Finite[ids[3]]))
    {
      ++rejected.PointNotFinite;
    }
    else
    {
      for (int i = 0; i < 4; ++i)
      {
        corners[i] = static_cast<std::int32_t>(ids[i]);
        // Reading first avoids writes to cache lines of points that are already marked, so that all
        // threads can share these lines.
        if (!this->Used[ids[i]].load(std::memory_order_relaxed))
        {
          this->Used[ids[i]].store(1, std::memory_order_relaxed);
        }
      }
      ++accepted;
    }
  }
}

//------------------------------------------------------------------------------
std::vector<MortonKey> TetrahedralMesh::Builder::KeysOfUsedPoints()
{
  const auto numberOfPoints = static_cast<std::size_t>(this->Input.NumberOfPoints);
  std::vector<PointBox> parts(NumberOfBlocks(numberOfPoints));
  std::vector<std::size_t> starts(parts.size());
  ForEachBlock(numberOfPoints, this->Loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      PointBox part;
      for (std::size_t p = first; p < last; ++p)
      {
        if (this->Used[p].load(std::memory_order_relaxed))
        {
          part.Add(this->Input.Points[p]);
          ++starts[block];
        }
      }
      parts[block] = part;
    });
  const PointBox all = Enclose(parts);
  this->Mesh.Center = all.GetCenter();
  this->Mesh.HalfSize = all.GetHalfSize();

  std::vector<MortonKey> keys(CountsToStarts(starts));
  const MortonCurve curve(all.Lower, all.Upper);
  std::vector<double> radii(parts.size(), 0.0);
  ForEachBlock(numberOfPoints, this->Loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      std::size_t next = starts[block];
      for (std::size_t p = first; p < last; ++p)
      {
        if (this->Used[p].load(std::memory_order_relaxed))
        {
          const glm::dvec3 point = this->Input.Points[p];
          radii[block] = std::max(radii[block], glm::length(point - this->Mesh.Center));
          keys[next++] = MakeMortonKey(curve.Code(point), p);
        }
      }
    });
  this->Mesh.Radius = *std::max_element(radii.begin(), radii.end());
  if (keys.size() > this->NumberOfCells)
  {
    this->TakeCodesOfCells(curve, keys);
  }
  return keys;
}

//------------------------------------------------------------------------------
/**
 * Replaces the code of each point by the lowest code of the centres of its cells. In meshes whose
 * cells share no points, the points of a cell are then adjacent in memory.
 */
void TetrahedralMesh::Builder::TakeCodesOfCells(
  const MortonCurve& curve, std::vector<MortonKey>& keys)
{
  const std::unique_ptr<std::atomic<std::uint32_t>[]> codes(
    new std::atomic<std::uint32_t>[this->Input.NumberOfPoints]);
  for (std::int64_t p = 0; p < this->Input.NumberOfPoints; ++p)
  {
    codes[p].store(std::numeric_limits<std::uint32_t>::max(), std::memory_order_relaxed);
  }
  ForEachInBlocks(this->Input.NumberOfCells, this->Loop,
    [&](std::size_t c)
    {
      const Quad& corners = this->CornersOf(c);
      if (corners[0] < 0)
      {
        return;
      }
      glm::dvec3 center(0.0);
      for (const std::int32_t corner : corners)
      {
        center += 0.25 * this->Input.Points[corner];
      }
      const std::uint32_t code = curve.Code(center);
      for (const std::int32_t corner : corners)
      {
        std::uint32_t lowest = codes[corner].load(std::memory_order_relaxed);
        while (code < lowest &&
          !codes[corner].compare_exchange_weak(lowest, code, std::memory_order_relaxed))
        {
        }
      }
    });
  for (MortonKey& key : keys)
  {
    const std::size_t point = IndexOf(key);
    key = MakeMortonKey(codes[point].load(std::memory_order_relaxed), point);
  }
}

//------------------------------------------------------------------------------
void TetrahedralMesh::Builder::NumberVertices()
{
  std::vector<MortonKey> keys = this->KeysOfUsedPoints();
  SortByCode(keys, this->Loop);
  this->VertexOfPoint.resize(this->Input.NumberOfPoints);
  ResizeTable(this->Mesh.SourcePoints, keys.size());
  ResizeTable(this->Mesh.Positions, keys.size());
  ForEachInBlocks(keys.size(), this->Loop,
    [this, &keys](std::size_t v)
    {
      const std::size_t point = IndexOf(keys[v]);
      this->VertexOfPoint[point] = static_cast<std::int32_t>(v);
      this->Mesh.SourcePoints[v] = static_cast<std::int32_t>(point);
    });
  this->Mesh.RoundPositions(this->Input.Points, this->Loop);
}

//------------------------------------------------------------------------------
/** Removes the cells that have the same four vertices as an earlier cell of the input. */
void TetrahedralMesh::Builder::RemoveDuplicates(const std::vector<MortonKey>& keys)
{
  std::vector<std::int32_t>& lowest = this->Mesh.Coincident;
  if (this->Input.MatchPositions)
  {
    lowest = this->Mesh.FindCoincident(this->Input.Points, this->Loop);
  }
  std::vector<Cell>& cells = this->Mesh.Cells;
  const auto verticesAt = [&cells, &lowest](std::size_t cell)
  {
    Quad vertices = cells[cell].Vertices;
    if (!lowest.empty())
    {
      for (std::int32_t& vertex : vertices)
      {
        vertex = lowest[vertex];
      }
      SortFour(vertices);
    }
    return vertices;
  };
  const std::vector<std::uint8_t> marks = MarkDuplicateCells(keys, verticesAt, this->Loop);
  std::size_t next = static_cast<std::size_t>(
    std::find(marks.begin(), marks.end(), std::uint8_t{ 1 }) - marks.begin());
  for (std::size_t c = next; c < marks.size(); ++c)
  {
    if (marks[c] == 0)
    {
      cells[next].Vertices = cells[c].Vertices;
      if (this->Input.KeepSourceCells)
      {
        this->Mesh.SourceCells[next] = this->Mesh.SourceCells[c];
      }
      ++next;
    }
  }
  this->Mesh.Rejected.Duplicate = static_cast<std::int64_t>(marks.size() - next);
  cells.resize(next);
  this->Mesh.SourceCells.resize(this->Input.KeepSourceCells ? next : 0);
}

//------------------------------------------------------------------------------
void TetrahedralMesh::Builder::NumberCells()
{
  std::vector<MortonKey> keys(this->NumberOfCells);
  ForEachBlock(this->Input.NumberOfCells, this->Loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      std::size_t next = this->CellStarts[block];
      for (std::size_t c = first; c < last; ++c)
      {
        Quad& corners = this->CornersOf(c);
        if (corners[0] < 0)
        {
          continue;
        }
        // The sum is within +-2^32, since positions are within +-2^30.
        std::int64_t sum[3] = { 0, 0, 0 };
        for (std::int32_t& corner : corners)
        {
          corner = this->VertexOfPoint[corner];
          const glm::ivec3& position = this->Mesh.Positions[corner];
          for (int axis = 0; axis < 3; ++axis)
          {
            sum[axis] += position[axis];
          }
        }
        SortFour(corners);
        keys[next++] = MakeMortonKey(MortonCode(sum, 33), c);
      }
    });
  SortByCode(keys, this->Loop);
  ResizeTable(this->Mesh.SourceCells, this->Input.KeepSourceCells ? keys.size() : 0);
  ForEachInBlocks(keys.size(), this->Loop,
    [this, &keys](std::size_t c)
    {
      const std::size_t source = IndexOf(keys[c]);
      this->Mesh.Cells[c].Vertices = this->CornersOf(source);
      if (this->Input.KeepSourceCells)
      {
        this->Mesh.SourceCells[c] = this->Input.SourceCells ? this->Input.SourceCells[source]
                                                            : static_cast<std::int32_t>(source);
      }
    });
  this->RemoveDuplicates(keys);
  if (this->Mesh.Cells.capacity() / 2 > this->Mesh.Cells.size())
  {
    this->Mesh.Cells.shrink_to_fit(); // most of the input was left out
  }
  ForEachInBlocks(this->Mesh.Cells.size(), this->Loop,
    [this](std::size_t c) { this->Mesh.Cells[c].Links.fill(NoNeighbor); });
}

}
