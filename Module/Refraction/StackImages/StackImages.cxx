// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/StackImages.h"

#include "Refraction/Images/SeamClosure.h"

#include <glm/geometric.hpp>

#include <algorithm>

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
  std::vector<StackPath> paths;
  StackSolver::Memory memory;
  for (std::size_t i = begin; i < end; ++i)
  {
    if (i % Chunk == 0)
    {
      memory = StackSolver::Memory();
    }
    const glm::dvec3 point = this->GetPoint(static_cast<std::int64_t>(i));
    this->States[i] = this->Solver.FindImages(point, memory, paths);
    this->Counts[i] = static_cast<std::uint32_t>(paths.size());
    for (const StackPath& path : paths)
    {
      ImagePoint image;
      image.Vertex = this->Solver.MakeVertex(point, path);
      image.Source[0] = static_cast<std::int64_t>(i);
      image.Passed = static_cast<std::int32_t>(path.Count);
      this->Chunks[i / Chunk].push_back(image);
    }
  }
}

//------------------------------------------------------------------------------
void StackImages::FinishPoints()
{
  this->Images.clear();
  for (const std::vector<ImagePoint>& chunk : this->Chunks)
  {
    this->Images.insert(this->Images.end(), chunk.begin(), chunk.end());
  }
  this->Chunks.clear();
  this->First.assign(this->States.size() + 1, 0);
  this->Farthest = 0.0;
  const glm::dvec3 eye = this->Solver.GetStack().GetEye() + this->Solver.GetStack().GetOrigin();
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
// True if a cell is behind parallel planes, on one leg, and its image is straight: the middles of
// its sides and its own middle are drawn within half of the tolerance of their exact sight rays, as
// those of other whole cells.
bool StackImages::IsDrawnBehindPlanes(const std::int64_t* ids, std::size_t count) const
{
  const ParallelPlanes& planes = this->Solver.GetPlanes();
  const RefractionStack& stack = this->Solver.GetStack();
  const bool isOnOneLeg = !planes.IsEmpty() &&
    std::all_of(ids, ids + count,
      [this, &planes, &stack, ids](std::int64_t id)
      {
        return this->GetNumberOfImages(static_cast<std::size_t>(id)) == 1 &&
          this->GetFirstImage(id).Passed == this->GetFirstImage(ids[0]).Passed &&
          planes.CountInFront(this->GetPoint(id) - stack.GetOrigin()) ==
          this->GetFirstImage(id).Passed;
      });
  if (!isOnOneLeg || count == 0 || this->GetFirstImage(ids[0]).Passed == 0)
  {
    return false;
  }
  const auto passed = static_cast<std::size_t>(this->GetFirstImage(ids[0]).Passed);
  const auto isDrawn = [this, &planes, &stack, passed](
                         const glm::dvec3& place, const glm::dvec3& image)
  {
    const glm::dvec3 drawn = image - stack.GetOrigin() - stack.GetEye();
    const glm::dvec3 sight = planes.FindSight(place - stack.GetOrigin(), passed, drawn);
    // Written so that a NaN fails.
    return glm::length(glm::cross(drawn, sight)) <= 0.5 * this->Tolerance * glm::length(drawn);
  };
  glm::dvec3 middle(0.0);
  glm::dvec3 image(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int64_t next = ids[(i + 1) % count];
    const glm::dvec3& seen = this->GetFirstImage(ids[i]).Vertex.Position;
    if (!isDrawn(0.5 * (this->GetPoint(ids[i]) + this->GetPoint(next)),
          0.5 * (seen + this->GetFirstImage(next).Vertex.Position)))
    {
      return false;
    }
    middle += this->GetPoint(ids[i]) / static_cast<double>(count);
    image += seen / static_cast<double>(count);
  }
  return isDrawn(middle, image);
}

//------------------------------------------------------------------------------
CellReport StackImages::MapLines(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, ImageMesh& pieces, ImageMesh& whole) const
{
  const StackMapper mapper(this->Solver, *this->Sheet);
  CellReport report;
  std::vector<StackMapper::Part> parts;
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::int64_t* ids = cells.Connectivity + cells.Offsets[i];
    const auto count = static_cast<std::size_t>(cells.Offsets[i + 1] - cells.Offsets[i]);
    if (this->AreInFront(ids, count) || this->IsDrawnBehindPlanes(ids, count))
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
  CellReport report;
  std::vector<std::int64_t> corners;
  std::vector<Triangle> triangles;
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::int64_t* ids = cells.Connectivity + cells.Offsets[i];
    const auto count = static_cast<std::size_t>(cells.Offsets[i + 1] - cells.Offsets[i]);
    if (!this->AreInRange(ids, count))
    {
      isMapped[i] = 0;
      ++report.Without;
      continue;
    }
    bool isWhole = this->AreInFront(ids, count) || this->IsDrawnBehindPlanes(ids, count);
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
void StackImages::MeetNeighbours(const ObjectCells& cells, std::size_t count,
  const unsigned char* isMapped, bool closesSeams, const ImageMesh& whole, ImageMesh& pieces,
  const RangeLoop& loop) const
{
  const std::vector<Seam> seams = FindSeams(cells, count, isMapped);
  if (seams.empty())
  {
    return;
  }
  const glm::dvec3 eye = this->Solver.GetStack().GetEye() + this->Solver.GetStack().GetOrigin();
  const auto move = [this, &eye](
                      std::int64_t low, std::int64_t high, double place, ImagePoint& point)
  {
    if (this->GetNumberOfImages(static_cast<std::size_t>(low)) == 1 &&
      this->GetNumberOfImages(static_cast<std::size_t>(high)) == 1)
    {
      this->MoveOntoEdge(this->GetFirstImage(low), this->GetFirstImage(high), place, eye, point);
    }
  };
  VisitPointsOnNeighbours(seams, cells, count, isMapped, pieces, loop, [&move]() { return move; });
  if (closesSeams)
  {
    this->CloseSeams(seams, cells, count, isMapped, eye, whole, pieces, loop);
  }
}

//------------------------------------------------------------------------------
// Moves a point onto the straight side of a whole polygon, if it is on the branch that the polygon
// draws.
void StackImages::MoveOntoEdge(const ImagePoint& low, const ImagePoint& high, double place,
  const glm::dvec3& eye, ImagePoint& point) const
{
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
