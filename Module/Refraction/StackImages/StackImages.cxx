// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/StackImages.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace meniscus
{

//------------------------------------------------------------------------------
void StackImages::SetPoints(const double* points, std::size_t count)
{
  this->ResetPoints(points, count);
  this->Sheet.reset();
  this->Chunks.assign((count + Chunk - 1) / Chunk, {});
}

//------------------------------------------------------------------------------
void StackImages::SolvePoints(std::size_t begin, std::size_t end)
{
  static_assert(Chunk == StackSolver::Chain, "a chunk is a chain");
  for (std::size_t first = begin; first < end; first += Chunk)
  {
    this->SolveChunk(first, std::min(first + Chunk, end));
  }
}

//------------------------------------------------------------------------------
// Points behind exact parallel planes have one image at most, and are solved together.
void StackImages::SolveChunk(std::size_t begin, std::size_t end)
{
  const std::size_t interfaces = this->Solver.GetStack().GetNumberOfInterfaces();
  std::array<VirtualVertex, Chunk> vertices;
  std::array<StackDetail, Chunk> details;
  std::vector<double> legs(Chunk * interfaces);
  std::vector<std::size_t> others;
  this->Solver.SolveBehindPlanes(this->Points + 3 * begin, 0, end - begin,
    { vertices.data(), details.data(), legs.data(), interfaces }, others);
  std::vector<StackPath> paths;
  StackSolver::Memory memory;
  ChunkImages& chunk = this->Chunks[begin / Chunk];
  chunk.Images.reserve(end - begin);
  chunk.Details.reserve(end - begin);
  chunk.Legs.reserve((end - begin) * interfaces);
  const auto add = [&](std::size_t i, const VirtualVertex& vertex, const StackDetail& detail)
  {
    ImagePoint image;
    image.Vertex = vertex;
    image.Source[0] = static_cast<std::int64_t>(i);
    image.Passed = detail.Passed;
    chunk.Images.push_back(image);
    chunk.Details.push_back(detail);
  };
  std::sort(others.begin(), others.end());
  auto other = others.cbegin();
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::size_t lane = i - begin;
    if (other == others.cend() || *other != lane)
    {
      this->States[i] = vertices[lane].State;
      this->Counts[i] = vertices[lane].State == ImageState::Found ? 1 : 0;
      if (this->Counts[i] > 0)
      {
        add(i, vertices[lane], details[lane]);
        const double* own = legs.data() + interfaces * lane;
        chunk.Legs.insert(chunk.Legs.end(), own, own + interfaces);
      }
      continue;
    }
    ++other;
    const glm::dvec3 point = this->GetPoint(static_cast<std::int64_t>(i));
    this->States[i] = this->Solver.FindImages(point, memory, paths);
    this->Counts[i] = static_cast<std::uint32_t>(paths.size());
    for (const StackPath& path : paths)
    {
      const StackVertex vertex = this->Solver.MakeVertex(point, path);
      add(i, vertex, vertex);
      chunk.Legs.resize(chunk.Legs.size() + interfaces);
      this->Solver.MeasureLegs(point, path, chunk.Legs.data() + chunk.Legs.size() - interfaces);
    }
  }
}

//------------------------------------------------------------------------------
void StackImages::FinishPoints()
{
  this->Images.clear();
  this->Details.clear();
  this->Legs.clear();
  std::size_t count = 0;
  for (const ChunkImages& chunk : this->Chunks)
  {
    count += chunk.Images.size();
  }
  this->Images.reserve(count);
  this->Details.reserve(count);
  this->Legs.reserve(count * this->Solver.GetStack().GetNumberOfInterfaces());
  for (const ChunkImages& chunk : this->Chunks)
  {
    this->Images.insert(this->Images.end(), chunk.Images.begin(), chunk.Images.end());
    this->Details.insert(this->Details.end(), chunk.Details.begin(), chunk.Details.end());
    this->Legs.insert(this->Legs.end(), chunk.Legs.begin(), chunk.Legs.end());
  }
  this->Chunks.clear();
  this->First.assign(this->States.size() + 1, 0);
  this->Farthest = 0.0;
  const glm::dvec3 eye = this->GetEye();
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    this->First[i + 1] = this->First[i] + this->Counts[i];
    if (this->States[i] != ImageState::NotFinite)
    {
      const glm::dvec3 away = this->GetPoint(static_cast<std::int64_t>(i)) - eye;
      this->Farthest = std::max(this->Farthest, glm::length(away));
    }
  }
}

//------------------------------------------------------------------------------
void StackImages::SetTolerance(double tolerance)
{
  if (!this->Sheet || tolerance != this->Tolerance)
  {
    this->Tolerance = tolerance;
    this->Sheet = std::make_unique<SightSheet>(this->Solver, tolerance, this->Farthest);
  }
}

//------------------------------------------------------------------------------
bool StackImages::AreInFront(const std::int64_t* ids, std::size_t count) const
{
  return std::all_of(ids, ids + count,
    [this](std::int64_t id)
    {
      return this->GetNumberOfImages(static_cast<std::size_t>(id)) == 1 &&
        this->GetFirstImage(id).Passed == 0;
    });
}

//------------------------------------------------------------------------------
// Finds cells that are drawn whole without tracing rays: those in front of all surfaces, and those
// behind parallel planes.
std::vector<bool> StackImages::FindWhole(
  const ObjectCells& cells, std::size_t begin, std::size_t end) const
{
  std::vector<bool> isWhole = this->FindWholeBehind(this->Solver.GetPlanes(), cells, begin, end);
  for (std::size_t i = begin; i < end; ++i)
  {
    const auto [ids, count] = cells.GetCell(i);
    isWhole[i - begin] = isWhole[i - begin] || this->AreInFront(ids, count);
  }
  return isWhole;
}

//------------------------------------------------------------------------------
CellReport StackImages::MapLines(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, ImageMesh& pieces, ImageMesh& whole) const
{
  const StackMapper mapper(this->Solver, *this->Sheet);
  const std::vector<bool> keepsPoints = this->FindWhole(cells, begin, end);
  CellReport report;
  std::vector<StackMapper::Part> parts;
  for (std::size_t i = begin; i < end; ++i)
  {
    const auto [ids, count] = cells.GetCell(i);
    if (keepsPoints[i - begin])
    {
      this->AddWhole(ids, count, names[i], whole);
      ++report.Whole;
      continue;
    }
    const std::size_t before = pieces.GetNumberOfCells();
    for (std::size_t k = 0; k + 1 < count; ++k)
    {
      if (!this->AreInRange(ids + k, 2))
      {
        continue;
      }
      const MappedTriangle line = this->MakeTriangle({ ids[k], ids[k + 1], ids[k] });
      const ObjectPrimitive primitive = mapper.MakeLine(line, names[i]);
      parts.clear();
      mapper.Clip(primitive, parts);
      mapper.Emit(primitive, parts, pieces);
    }
    report.Count(false, pieces.GetNumberOfCells() > before);
  }
  return report;
}

//------------------------------------------------------------------------------
CellReport StackImages::MapPolygons(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, const Triangulate& triangulate, ImageMesh& pieces,
  ImageMesh& whole, unsigned char* isMapped) const
{
  const StackMapper mapper(this->Solver, *this->Sheet);
  const std::vector<bool> keepsPoints = this->FindWhole(cells, begin, end);
  CellReport report;
  std::vector<std::int64_t> corners;
  std::vector<Triangle> triangles;
  for (std::size_t i = begin; i < end; ++i)
  {
    const auto [ids, count] = cells.GetCell(i);
    if (!this->AreInRange(ids, count))
    {
      isMapped[i] = 0;
      ++report.Without;
      continue;
    }
    bool isWhole = keepsPoints[i - begin];
    triangles.clear();
    if (!isWhole)
    {
      corners = { 0, 1, 2 };
      if (count != 3)
      {
        triangulate(ids, count, corners);
      }
      for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
      {
        triangles.push_back(
          { this->MakeTriangle({ ids[corners[k]], ids[corners[k + 1]], ids[corners[k + 2]] }),
            {} });
      }
      isWhole = this->ClipTriangles(mapper, names[i], triangles);
    }
    isMapped[i] = isWhole ? 0 : 1;
    if (isWhole)
    {
      this->AddWhole(ids, count, names[i], whole);
      ++report.Whole;
      continue;
    }
    const std::size_t before = pieces.GetNumberOfCells();
    for (const Triangle& triangle : triangles)
    {
      mapper.Emit(mapper.MakeTriangle(triangle.Corners, names[i]), triangle.Parts, pieces);
    }
    report.Count(false, pieces.GetNumberOfCells() > before);
  }
  return report;
}

//------------------------------------------------------------------------------
// Returns true if the polygon that the triangles make up can keep its points.
bool StackImages::ClipTriangles(
  const StackMapper& mapper, std::int64_t name, std::vector<Triangle>& triangles) const
{
  bool isWhole = !triangles.empty();
  for (Triangle& triangle : triangles)
  {
    const ObjectPrimitive primitive = mapper.MakeTriangle(triangle.Corners, name);
    mapper.Clip(primitive, triangle.Parts);
    // The sheet is within the tolerance of the rays, the triangle within half of it of the sheet.
    isWhole = isWhole && mapper.IsWhole(primitive, triangle.Parts, 0.5 * this->Tolerance);
  }
  return isWhole;
}

//------------------------------------------------------------------------------
CellImages::MoveOntoSide StackImages::MakeMove() const
{
  return [this](std::int64_t low, std::int64_t high, double place, ImagePoint& point)
  {
    if (this->GetNumberOfImages(static_cast<std::size_t>(low)) == 1 &&
      this->GetNumberOfImages(static_cast<std::size_t>(high)) == 1)
    {
      this->MoveOntoEdge(this->GetFirstImage(low), this->GetFirstImage(high), place, point);
    }
  };
}

//------------------------------------------------------------------------------
glm::dvec3 StackImages::GetEye() const
{
  return this->Solver.GetStack().GetEye() + this->Solver.GetStack().GetOrigin();
}

//------------------------------------------------------------------------------
// Moves a point onto the straight side of a whole polygon, if it is on the branch that the polygon
// draws.
void StackImages::MoveOntoEdge(
  const ImagePoint& low, const ImagePoint& high, double place, ImagePoint& point) const
{
  const glm::dvec3 eye = this->GetEye();
  // The polygon and the piece are each within the tolerance of the true image.
  constexpr double sameBranch = 2.0;
  const glm::dvec3 drawn = (1.0 - place) * low.Vertex.Position + place * high.Vertex.Position;
  const glm::dvec3 there = drawn - eye;
  const glm::dvec3 seen = point.Vertex.Position - eye;
  if (low.Passed == point.Passed && high.Passed == point.Passed &&
    glm::length(glm::cross(there, seen)) <=
      sameBranch * this->Tolerance * glm::length(there) * glm::length(seen))
  {
    point.Vertex.Position = drawn;
  }
}

}
