// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackCellScene.h"

#include "Refraction/Stack/StackSolver.h"
#include "RefractionTestRandom.h"
#include "TestBasics.h"

using namespace meniscus::test;

namespace meniscus::test
{
namespace
{

const double Pi = std::acos(-1.0);

// A place of the object on a ray, by triangle.
struct Hit
{
  std::size_t Cell;
  bool IsClear; ///< away from the triangle's sides and the ends of the leg
};

// Hits of a path's legs that are seen.
std::vector<Hit> FindHits(
  const StackSolver& solver, const Object& object, const StackPath& path, PathEnd end, double clear)
{
  const RefractionStack& stack = solver.GetStack();
  const std::size_t links = stack.GetLinks().size();
  std::vector<glm::dvec3> from{ stack.GetEye() };
  std::vector<glm::dvec3> to;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    to.push_back(path.Points[k].Ray.Origin);
    from.push_back(path.Points[k].Ray.Origin);
  }
  if (end == PathEnd::Passed)
  {
    to.push_back(from.back() + 1e4 * path.Points[links - 1].Ray.Direction);
  }
  else if (end == PathEnd::Reflected)
  {
    to.push_back(path.Points[path.Count].Ray.Origin);
  }
  std::vector<Hit> hits;
  for (const auto& [leg, cell] :
    Product(Below<std::size_t>(to.size()), Below<std::size_t>(object.GetCount())))
  {
    const glm::dvec3 a = object.GetCorner(cell, 0) - stack.GetOrigin();
    const glm::dvec3 u = object.GetCorner(cell, 1) - stack.GetOrigin() - a;
    const glm::dvec3 v = object.GetCorner(cell, 2) - stack.GetOrigin() - a;
    const glm::dvec3 way = to[leg] - from[leg];
    const glm::dvec3 n = glm::cross(u, v);
    const double t = glm::dot(a - from[leg], n) / glm::dot(way, n);
    const glm::dvec3 at = from[leg] + t * way - a;
    const double y = glm::dot(glm::cross(at, v), n) / glm::dot(n, n);
    const double z = glm::dot(glm::cross(u, at), n) / glm::dot(n, n);
    const double margin = std::min({ y, z, 1.0 - y - z });
    const double length = glm::length(way);
    const double near = std::min(t, 1.0 - t) * length;
    if (margin > -clear && near > -100.0 * clear)
    {
      hits.push_back({ cell, margin > clear && near > 100.0 * clear });
    }
  }
  return hits;
}

// Number of places of each triangle that a sight ray shows: none if it does not meet the first
// surface from its front. Nothing if a place is not clear.
std::optional<std::vector<int>> FindTruth(
  const StackSolver& solver, const Object& object, const glm::dvec3& direction)
{
  const RefractionStack& stack = solver.GetStack();
  SurfaceCrossing crossing;
  std::vector<int> truth(object.GetCount(), 0);
  if (!stack.FindNext(0, stack.GetEye(), direction, crossing))
  {
    return truth;
  }
  StackPath path;
  const PathEnd end =
    stack.Trace({ crossing.Facet, crossing.B }, stack.GetLinks().size(), false, path);
  for (const Hit& hit : FindHits(solver, object, path, end, 2e-3))
  {
    if (!hit.IsClear)
    {
      return std::nullopt;
    }
    ++truth[hit.Cell];
  }
  return truth;
}

}

//------------------------------------------------------------------------------
void Object::Map(const StackSolver& solver, double tolerance)
{
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> names;
  for (std::size_t i = 0; i <= this->GetCount(); ++i)
  {
    offsets.push_back(static_cast<std::int64_t>(3 * i));
    names.push_back(static_cast<std::int64_t>(i));
  }
  StackImages images(solver);
  images.SetPoints(&this->Points[0].x, this->Points.size());
  images.SolvePoints(0, this->Points.size());
  images.FinishPoints();
  images.SetTolerance(tolerance);
  const ObjectCells cells{ offsets.data(), this->Connectivity.data() };
  std::vector<unsigned char> isMapped(this->GetCount());
  const auto noPolygons = [](const std::int64_t*, std::size_t, std::vector<std::int64_t>& t)
  { t.clear(); };
  this->Report = images.MapPolygons(cells, names.data(), 0, this->GetCount(), noPolygons,
    this->Pieces, this->Whole, isMapped.data());
  images.MeetNeighbours(
    cells, this->GetCount(), isMapped.data(), true, this->Whole, this->Pieces, SerialLoop);
  this->PointImages = images.GetPointImages();
}

//------------------------------------------------------------------------------
std::vector<Piece> ListPieces(const Object& object, const glm::dvec3& eye)
{
  std::vector<Piece> pieces;
  for (const ImageMesh* mesh : { &object.Pieces, &object.Whole })
  {
    const std::vector<ImagePoint>& points =
      mesh == &object.Whole ? object.PointImages : mesh->Points;
    std::int64_t begin = 0;
    for (std::size_t i = 0; i < mesh->GetNumberOfCells(); ++i)
    {
      Piece piece;
      piece.Cell = static_cast<std::size_t>(mesh->SourceCells[i]);
      for (std::int64_t k = begin; k < mesh->Ends[i]; ++k)
      {
        const auto id = static_cast<std::size_t>(mesh->Connectivity[static_cast<std::size_t>(k)]);
        piece.Corners.push_back(glm::normalize(points[id].Vertex.Position - eye));
        piece.Middle += piece.Corners.back();
      }
      piece.Middle = glm::normalize(piece.Middle);
      for (const glm::dvec3& corner : piece.Corners)
      {
        piece.Cosine = std::min(piece.Cosine, glm::dot(corner, piece.Middle));
      }
      begin = mesh->Ends[i];
      pieces.push_back(piece);
    }
  }
  return pieces;
}

//------------------------------------------------------------------------------
bool Covers(const std::vector<glm::dvec3>& corners, const glm::dvec3& direction)
{
  bool hasLeft = false;
  bool hasRight = false;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec3& next = corners[(i + 1) % corners.size()];
    if (glm::length(next - corners[i]) < 1e-13)
    {
      continue;
    }
    const double side = glm::dot(direction, glm::cross(corners[i], next));
    hasLeft = hasLeft || side > 0.0;
    hasRight = hasRight || side < 0.0;
    if (!(glm::dot(direction, corners[i]) > 0.0))
    {
      return false;
    }
  }
  return hasLeft != hasRight;
}

//------------------------------------------------------------------------------
Comparison Compare(const StackSolver& solver, const Object& object, int rays, unsigned seed)
{
  const RefractionStack& stack = solver.GetStack();
  const glm::dvec3 eye = stack.GetEye() + stack.GetOrigin();
  const std::vector<Piece> pieces = ListPieces(object, eye);
  const RefractingSurface& first = *stack.GetLinks()[0].Surface;
  const auto facets = static_cast<double>(first.GetMembrane().GetFacets().size());
  Random random(seed);
  Comparison result;
  for (int i = 0; i < rays; ++i)
  {
    const auto facet = static_cast<std::int32_t>(random(0.0, facets));
    const double u = random(0.0, 1.0);
    const PatchPoint aim = first.GetPatches().GetPatch(facet).Evaluate({ u, random(0.0, 1.0 - u) });
    const glm::dvec3 direction =
      glm::normalize(aim.Position + stack.GetLinks()[0].Shift - stack.GetEye());
    // As many rays as pixels: few to parts of the surface that are seen at a slant.
    if (std::fabs(glm::dot(direction, glm::normalize(aim.Normal))) < random(0.0, 1.0))
    {
      continue;
    }
    const auto truth = FindTruth(solver, object, direction);
    if (!truth)
    {
      continue;
    }
    std::vector<int> found(object.GetCount(), 0);
    for (const Piece& piece : pieces)
    {
      found[piece.Cell] += glm::dot(direction, piece.Middle) >= piece.Cosine - 1e-12 &&
        Covers(piece.Corners, direction);
    }
    ++result.Rays;
    result.Hits += std::accumulate(truth->begin(), truth->end(), 0);
    bool isRight = found == *truth;
    result.Off += !isRight;
    const glm::dvec3 x = glm::normalize(glm::cross(direction, glm::dvec3(0.36, 0.48, 0.8)));
    const glm::dvec3 y = glm::cross(direction, x);
    for (int k = 0; k < 16 && !isRight; ++k)
    {
      const double angle = 2.0 * Pi * k / 16.0;
      const double size = Tolerance * (k % 2 == 0 ? 1.0 : 0.3);
      const auto near = FindTruth(solver, object,
        glm::normalize(direction + size * (std::cos(angle) * x + std::sin(angle) * y)));
      isRight = near && *near == found;
    }
    result.Wrong += !isRight;
  }
  return result;
}

//------------------------------------------------------------------------------
void ExpectExactPoints(const StackSolver& solver, const Object& object, double largest)
{
  const glm::dvec3 eye = solver.GetStack().GetEye() + solver.GetStack().GetOrigin();
  for (const ImagePoint& image : object.Pieces.Points)
  {
    StackPath path;
    solver.Retrace(
      image.Vertex.SightPoint, image.Vertex.Facet, static_cast<std::size_t>(image.Passed), path);
    if (path.Count < static_cast<std::size_t>(image.Passed))
    {
      continue; // at a limit
    }
    const glm::dvec3 local = object.GetPoint(image) - solver.GetStack().GetOrigin();
    const glm::dvec3 from = path.Count > 0 ? path.GetLast().Origin : solver.GetStack().GetEye();
    const glm::dvec3 direction =
      path.Count > 0 ? path.GetLast().Direction : glm::normalize(image.Vertex.SightPoint - eye);
    ASSERT_LT(glm::length(glm::cross(local - from, direction)), largest) << image.Passed;
  }
}
}
