// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/TetrahedralMesh.h"

#include "Volume/BlockLoop.h"
#include "Volume/MortonOrder.h"
#include "Volume/VisibleScalars.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace meniscus
{
namespace
{

glm::dvec3 PointAt(const TetrahedraView& input, std::int64_t index)
{
  const double* p = input.Points + 3 * index;
  return { p[0], p[1], p[2] };
}

bool IsFinite(const glm::dvec3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/** The three vertices of a cell other than number `face`, still ascending. */
std::array<std::int32_t, 3> FaceVertices(const TetrahedralMesh::Cell& cell, int face)
{
  std::array<std::int32_t, 3> vertices{};
  for (int i = 0, n = 0; i < 4; ++i)
  {
    if (i != face)
    {
      vertices[n++] = cell.Vertices[i];
    }
  }
  return vertices;
}

/**
 * Orientation of the ascending face opposite to vertex `face`, relative to the cell's: with the
 * cell's vertices positively oriented, the face's normal points out for face 0 and 2.
 */
int FaceParity(int face)
{
  return face % 2 == 0 ? 1 : -1;
}

/** Six times the signed volume of the ascending vertices. */
double SixfoldVolume(const TetrahedralMesh::Cell& cell, const std::vector<glm::vec3>& positions)
{
  const glm::dvec3 origin(positions[cell.Vertices[0]]);
  const glm::dvec3 a = glm::dvec3(positions[cell.Vertices[1]]) - origin;
  const glm::dvec3 b = glm::dvec3(positions[cell.Vertices[2]]) - origin;
  const glm::dvec3 c = glm::dvec3(positions[cell.Vertices[3]]) - origin;
  return glm::dot(glm::cross(a, b), c);
}

/** A face filed under its lowest vertex. */
struct FiledFace
{
  std::int32_t Middle;
  std::int32_t Highest;
  std::int32_t CellFace;
};

/** What a block of cells adds to the sums over all. */
struct BlockCount
{
  std::int64_t Active = 0;
  std::int64_t Changed = 0;
};

/** All faces, grouped by lowest vertex: First[v] is where the group of vertex v begins. */
struct FaceFile
{
  std::vector<std::int64_t> First;
  std::vector<FiledFace> Faces;
};

FaceFile FileFaces(const std::vector<TetrahedralMesh::Cell>& cells, std::size_t numberOfVertices)
{
  FaceFile file;
  file.First.assign(numberOfVertices + 2, 0);
  for (const auto& cell : cells)
  {
    // Three faces contain the cell's lowest vertex; the fourth begins with the second lowest.
    file.First[cell.Vertices[0] + 2] += 3;
    file.First[cell.Vertices[1] + 2] += 1;
  }
  for (std::size_t v = 2; v < file.First.size(); ++v)
  {
    file.First[v] += file.First[v - 1];
  }
  file.Faces.resize(4 * cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    for (int face = 0; face < 4; ++face)
    {
      const auto v = FaceVertices(cells[c], face);
      file.Faces[file.First[v[0] + 1]++] = { v[1], v[2], static_cast<std::int32_t>(4 * c + face) };
    }
  }
  return file;
}

}

//------------------------------------------------------------------------------
void TetrahedralMesh::Clear()
{
  *this = TetrahedralMesh();
}

//------------------------------------------------------------------------------
MeshStatus TetrahedralMesh::Build(const TetrahedraView& input)
{
  this->Clear();
  // A vertex index is 31 bits, and so is a link.
  if (input.NumberOfCells > MaximumNumberOfCells ||
    input.NumberOfPoints > std::numeric_limits<std::int32_t>::max())
  {
    return MeshStatus::TooLarge;
  }
  this->ValidateCells(input);
  if (this->SourceCells.empty())
  {
    return MeshStatus::Empty;
  }
  this->NumberVertices(input);
  this->NumberCells(input);
  this->LinkCells();
  this->OrientCells();
  this->ActiveCells = this->GetNumberOfCells();
  this->CollectBoundary(SerialLoop);
  return MeshStatus::Ok;
}

//------------------------------------------------------------------------------
void TetrahedralMesh::ValidateCells(const TetrahedraView& input)
{
  this->SourceCells.reserve(input.NumberOfCells);
  for (std::int64_t c = 0; c < input.NumberOfCells; ++c)
  {
    const std::int64_t* ids = input.Cells + 4 * c;
    const auto inRange = [&input](std::int64_t id) { return id >= 0 && id < input.NumberOfPoints; };
    if (!std::all_of(ids, ids + 4, inRange))
    {
      ++this->Rejected.IndexOutOfRange;
      continue;
    }
    std::array<std::int64_t, 4> sorted{ ids[0], ids[1], ids[2], ids[3] };
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    {
      ++this->Rejected.RepeatedVertex;
      continue;
    }
    const auto finite = [&input](std::int64_t id) { return IsFinite(PointAt(input, id)); };
    if (!std::all_of(ids, ids + 4, finite))
    {
      ++this->Rejected.PointNotFinite;
      continue;
    }
    this->SourceCells.push_back(c);
  }
}

//------------------------------------------------------------------------------
void TetrahedralMesh::NumberVertices(const TetrahedraView& input)
{
  std::vector<std::uint8_t> used(input.NumberOfPoints, 0);
  for (const std::int64_t c : this->SourceCells)
  {
    for (int i = 0; i < 4; ++i)
    {
      used[input.Cells[4 * c + i]] = 1;
    }
  }
  std::vector<std::int64_t> points;
  glm::dvec3 lower(std::numeric_limits<double>::infinity());
  glm::dvec3 upper(-std::numeric_limits<double>::infinity());
  for (std::int64_t p = 0; p < input.NumberOfPoints; ++p)
  {
    if (used[p])
    {
      points.push_back(p);
      lower = glm::min(lower, PointAt(input, p));
      upper = glm::max(upper, PointAt(input, p));
    }
  }
  this->Center = 0.5 * lower + 0.5 * upper;

  const MortonCurve curve(lower, upper);
  std::vector<std::uint32_t> codes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    codes[i] = curve.Code(PointAt(input, points[i]));
  }
  for (const std::int64_t p : points)
  {
    this->Radius = std::max(this->Radius, glm::length(PointAt(input, p) - this->Center));
  }
  const double scale = this->Radius > 0.0 ? 1.0 / this->Radius : 0.0;
  this->SourcePoints.reserve(points.size());
  this->Positions.reserve(points.size());
  for (const std::int64_t i : SortedOrder(codes))
  {
    this->SourcePoints.push_back(points[i]);
    this->Positions.emplace_back((PointAt(input, points[i]) - this->Center) * scale);
  }
}

//------------------------------------------------------------------------------
void TetrahedralMesh::NumberCells(const TetrahedraView& input)
{
  std::vector<std::int32_t> vertexOfPoint(input.NumberOfPoints, -1);
  for (std::size_t v = 0; v < this->SourcePoints.size(); ++v)
  {
    vertexOfPoint[this->SourcePoints[v]] = static_cast<std::int32_t>(v);
  }

  const glm::dvec3 box(1.0); // positions are in units of the radius
  const MortonCurve curve(-box, box);
  std::vector<std::uint32_t> codes(this->SourceCells.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    glm::dvec3 centroid(0.0);
    for (int k = 0; k < 4; ++k)
    {
      const std::int64_t point = input.Cells[4 * this->SourceCells[i] + k];
      centroid += 0.25 * glm::dvec3(this->Positions[vertexOfPoint[point]]);
    }
    codes[i] = curve.Code(centroid);
  }

  const std::vector<std::int64_t> accepted = std::move(this->SourceCells);
  this->SourceCells.clear();
  this->SourceCells.reserve(accepted.size());
  this->Cells.reserve(accepted.size());
  for (const std::int64_t i : SortedOrder(codes))
  {
    Cell cell;
    for (int k = 0; k < 4; ++k)
    {
      cell.Vertices[k] = vertexOfPoint[input.Cells[4 * accepted[i] + k]];
    }
    std::sort(cell.Vertices.begin(), cell.Vertices.end());
    cell.Links.fill(NoNeighbor);
    this->SourceCells.push_back(accepted[i]);
    this->Cells.push_back(cell);
  }
}

//------------------------------------------------------------------------------
void TetrahedralMesh::LinkCells()
{
  FaceFile file = FileFaces(this->Cells, this->Positions.size());
  const auto before = [](const FiledFace& a, const FiledFace& b)
  { return a.Middle != b.Middle ? a.Middle < b.Middle : a.Highest < b.Highest; };
  for (std::size_t v = 0; v < this->Positions.size(); ++v)
  {
    const auto first = file.Faces.begin() + file.First[v];
    const auto last = file.Faces.begin() + file.First[v + 1];
    std::sort(first, last, before);
    for (auto group = first; group != last;)
    {
      const auto groupEnd =
        std::find_if(group, last, [&](const FiledFace& f) { return before(*group, f); });
      if (groupEnd - group == 2)
      {
        const std::int32_t a = group[0].CellFace;
        const std::int32_t b = group[1].CellFace;
        this->Cells[a / 4].Links[a % 4] = b;
        this->Cells[b / 4].Links[b % 4] = a;
      }
      group = groupEnd;
    }
  }
}

//------------------------------------------------------------------------------
void TetrahedralMesh::CutLink(std::int32_t cell, int face)
{
  const std::int32_t other = this->Cells[cell].Links[face];
  this->Cells[other / 4].Links[other % 4] = NoNeighbor;
  this->Cells[cell].Links[face] = NoNeighbor;
  ++this->CutLinks;
}

//------------------------------------------------------------------------------
void TetrahedralMesh::OrientCells()
{
  this->Orientation.assign(this->Cells.size(), 0);
  std::vector<std::int32_t> component;
  for (std::size_t seed = 0; seed < this->Cells.size(); ++seed)
  {
    if (this->Orientation[seed] != 0)
    {
      continue;
    }
    component.assign(1, static_cast<std::int32_t>(seed));
    this->Orientation[seed] = 1;
    double volume = 0.0;
    for (std::size_t next = 0; next < component.size(); ++next)
    {
      const std::int32_t cell = component[next];
      volume += this->Orientation[cell] * SixfoldVolume(this->Cells[cell], this->Positions);
      for (int face = 0; face < 4; ++face)
      {
        const std::int32_t link = this->Cells[cell].Links[face];
        if (link == NoNeighbor)
        {
          continue;
        }
        // Two cells agree if they see their common face from opposite sides.
        const int wanted = -this->Orientation[cell] * FaceParity(face) * FaceParity(link % 4);
        std::int8_t& found = this->Orientation[link / 4];
        if (found == 0)
        {
          found = static_cast<std::int8_t>(wanted);
          component.push_back(link / 4);
        }
        else if (found != wanted)
        {
          this->CutLink(cell, face);
        }
      }
    }
    if (volume < 0.0)
    {
      for (const std::int32_t cell : component)
      {
        this->Orientation[cell] = static_cast<std::int8_t>(-this->Orientation[cell]);
      }
    }
  }
}

//------------------------------------------------------------------------------
bool TetrahedralMesh::UpdateActiveCells(
  const std::vector<float>& scalars, const VisibleScalars& visible, const RangeLoop& loop)
{
  std::vector<std::uint8_t> active(this->Cells.size());
  std::vector<BlockCount> counts(NumberOfBlocks(this->Cells.size()));
  ForEachBlock(this->Cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      BlockCount count;
      for (std::size_t c = first; c < last; ++c)
      {
        const auto& v = this->Cells[c].Vertices;
        const float s[4] = { scalars[v[0]], scalars[v[1]], scalars[v[2]], scalars[v[3]] };
        // The sum of normalised scalars is NaN if one of them is.
        const bool known = !std::isnan(s[0] + s[1] + s[2] + s[3]);
        active[c] = known &&
          visible.Meets(std::min(std::min(s[0], s[1]), std::min(s[2], s[3])),
            std::max(std::max(s[0], s[1]), std::max(s[2], s[3])));
        count.Active += active[c];
        count.Changed += active[c] != (std::abs(this->Orientation[c]) == 1);
      }
      counts[block] = count;
    });
  BlockCount total;
  for (const BlockCount& count : counts)
  {
    total.Active += count.Active;
    total.Changed += count.Changed;
  }
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
void TetrahedralMesh::MarkLinks(const std::vector<std::uint8_t>& active, const RangeLoop& loop)
{
  ForEachBlock(this->Cells.size(), loop,
    [this, &active](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        const int sign = this->Orientation[c] > 0 ? 1 : -1;
        this->Orientation[c] = static_cast<std::int8_t>(active[c] ? sign : 2 * sign);
        for (std::int32_t& link : this->Cells[c].Links)
        {
          if (link != NoNeighbor)
          {
            const std::int32_t neighbor = link < NoNeighbor ? MarkedLink(link) : link;
            link = active[neighbor / 4] ? neighbor : MarkedLink(neighbor);
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
void TetrahedralMesh::CollectBoundary(const RangeLoop& loop)
{
  const auto isBoundary = [this](std::size_t c, int face)
  { return std::abs(this->Orientation[c]) == 1 && this->Cells[c].Links[face] < 0; };

  // Counted before they are written, so that the order is that of the cells on any threads.
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
            this->Boundary[next++] = { FaceVertices(this->Cells[c], face),
              FaceParity(face) * this->Orientation[c], static_cast<std::int32_t>(4 * c + face) };
          }
        }
      }
    });
}

}
