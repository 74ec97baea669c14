// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of triangles and lines through several surfaces. Truth: rays that are traced one by one
// and intersected with the object on each leg.
#include "Refraction/StackImages/StackImages.h"
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace
{

using meniscus::CellReport;
using meniscus::ImageMesh;
using meniscus::ImagePoint;
using meniscus::ObjectCells;
using meniscus::PathEnd;
using meniscus::RefractionStack;
using meniscus::StackImages;
using meniscus::StackPath;
using meniscus::StackSolver;
using meniscus::reference::MakePlane;
using meniscus::reference::MakeSphere;
using meniscus::reference::MembraneMesh;
using meniscus::testing::MakeSurface;
using meniscus::testing::MakeWaves;
using meniscus::testing::Random;
using meniscus::testing::SetStack;

const double Pi = std::acos(-1.0);

// An object of triangles and its images.
struct Object
{
  std::vector<glm::dvec3> Points;
  std::vector<std::int64_t> Connectivity;
  ImageMesh Pieces;
  ImageMesh Whole;
  CellReport Report;
  std::vector<ImagePoint> PointImages;

  void AddTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
  {
    for (const glm::dvec3& p : { a, b, c })
    {
      this->Connectivity.push_back(static_cast<std::int64_t>(this->Points.size()));
      this->Points.push_back(p);
    }
  }

  // A parallelogram of two triangles that share two points.
  void AddQuad(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v)
  {
    const auto first = static_cast<std::int64_t>(this->Points.size());
    for (const glm::dvec3& p : { corner, corner + u, corner + u + v, corner + v })
    {
      this->Points.push_back(p);
    }
    for (const std::int64_t i : { 0, 1, 2, 0, 2, 3 })
    {
      this->Connectivity.push_back(first + i);
    }
  }

  std::size_t GetCount() const { return this->Connectivity.size() / 3; }
  const glm::dvec3& GetCorner(std::size_t cell, std::size_t k) const
  {
    return this->Points[static_cast<std::size_t>(this->Connectivity[3 * cell + k])];
  }

  void Map(const StackSolver& solver, double tolerance)
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
      cells, this->GetCount(), isMapped.data(), true, this->Whole, this->Pieces);
    this->PointImages = images.GetPointImages();
  }

  glm::dvec3 GetPoint(const ImagePoint& image) const
  {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < image.GetNumberOfSources(); ++k)
    {
      sum += image.Weight[k] * this->Points[static_cast<std::size_t>(image.Source[k])];
    }
    return sum;
  }
};

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
  for (std::size_t leg = 0; leg < to.size(); ++leg)
  {
    for (std::size_t cell = 0; cell < object.GetCount(); ++cell)
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
  }
  return hits;
}

// True if a direction is in the cone over a convex polygon.
bool Covers(const std::vector<glm::dvec3>& corners, const glm::dvec3& direction)
{
  bool hasLeft = false;
  bool hasRight = false;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const double side =
      glm::dot(direction, glm::cross(corners[i], corners[(i + 1) % corners.size()]));
    hasLeft = hasLeft || side > 0.0;
    hasRight = hasRight || side < 0.0;
    if (!(glm::dot(direction, corners[i]) > 0.0))
    {
      return false;
    }
  }
  return hasLeft != hasRight;
}

struct Comparison
{
  int Rays = 0; ///< with hits that are all clear
  int Off = 0;  ///< of these: another number of pieces of some triangle
  int Wrong = 0;
  int Hits = 0;
};

// Half of a pixel of 0.06 degrees.
constexpr double Tolerance = 5e-4;

// A piece of an image as a cone of directions.
struct Piece
{
  std::vector<glm::dvec3> Corners;
  glm::dvec3 Middle{ 0.0 };
  double Cosine = 1.0; ///< of the circular cone around the middle that holds the corners
  std::size_t Cell;
};

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

// Number of places of each triangle that a sight ray shows: none if it does not meet the first
// surface from its front. Nothing if a place is not clear.
std::optional<std::vector<int>> FindTruth(
  const StackSolver& solver, const Object& object, const glm::dvec3& direction)
{
  const RefractionStack& stack = solver.GetStack();
  meniscus::SurfaceCrossing crossing;
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

// Shoots random rays to the first surface. A ray is wrong if neither it nor one within
// the tolerance of it shows each triangle as often as pieces of its image cover the ray.
Comparison Compare(const StackSolver& solver, const Object& object, int rays, unsigned seed)
{
  const RefractionStack& stack = solver.GetStack();
  const glm::dvec3 eye = stack.GetEye() + stack.GetOrigin();
  const std::vector<Piece> pieces = ListPieces(object, eye);
  const meniscus::StackSurface& first = *stack.GetLinks()[0].Surface;
  const auto facets = static_cast<double>(first.GetMembrane().GetFacets().size());
  Random random(seed);
  Comparison result;
  for (int i = 0; i < rays; ++i)
  {
    const auto facet = static_cast<std::int32_t>(random(0.0, facets));
    const double u = random(0.0, 1.0);
    const meniscus::PatchPoint aim =
      first.GetPatches().GetPatch(facet).Evaluate({ u, random(0.0, 1.0 - u) });
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

// Each point of the output is where its sight ray shows the object's point.
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

//------------------------------------------------------------------------------
// A slanted square that crosses both planes: each place of it is seen once.
TEST(RefractionStackCells, SquareThroughTwoPlanesHasNoGaps)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 200.0, 8)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(-20.0, 200.0, 6)), { 1.5, 1.333 } } },
    { 5.0, 80.0, -3.0 });
  Object object;
  object.AddQuad({ -30.0, 12.0, -20.0 }, { 55.0, -60.0, 3.0 }, { 5.0, 2.0, 38.0 });
  object.Map(solver, Tolerance);
  const Comparison result = Compare(solver, object, 20000, 31);
  EXPECT_GT(result.Hits, 700);
  EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays;
  ExpectExactPoints(solver, object, 1e-8);
  EXPECT_EQ(object.Report.Mapped, 2u);
}

//------------------------------------------------------------------------------
// Far behind two wavy surfaces triangles are seen several times, mirrored and folded.
TEST(RefractionStackCells, ImagesThroughTwoWavySurfacesCoverTheTracedRays)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 1.3, 8.0, 24)), { 1.0, 1.5 } },
      { MakeSurface(MakeWaves(100.0, -12.0, 1.0, 9.0, 28)), { 1.5, 1.2 } } },
    { 5.0, 90.0, -8.0 });
  Object object;
  object.AddQuad({ -30.0, -90.0, -30.0 }, { 60.0, 5.0, 0.0 }, { 0.0, -8.0, 60.0 });
  object.AddTriangle({ -30.0, -40.0, 10.0 }, { -2.0, -160.0, 15.0 }, { 10.0, -60.0, 30.0 });
  object.AddTriangle({ 0.0, 8.0, -30.0 }, { 25.0, -5.0, -28.0 }, { 12.0, -30.0, -35.0 });
  object.Map(solver, Tolerance);
  const Comparison result = Compare(solver, object, 8000, 32);
  EXPECT_GT(result.Hits, 500);
  EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays;
  ExpectExactPoints(solver, object, 1e-6);
  RecordProperty("hits", result.Hits);
  RecordProperty("off", result.Off);
  RecordProperty("wrong", result.Wrong);
  RecordProperty("rays", result.Rays);
}

//------------------------------------------------------------------------------
// The second surface is smaller than the first, and reflects the rays on one side totally: what
// lies between the surfaces is seen only on rays that go on to it.
TEST(RefractionStackCells, RaysThatEndEarlierShowWhatIsBefore)
{
  StackSolver solver;
  MembraneMesh small = MakePlane(-10.0, 40.0, 5);
  small.Translate({ 12.0, 0.0, 0.0 });
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 0.6, 5.0, 16)), { 1.0, 1.6 } },
      { MakeSurface(small), { 1.6, 1.0 } } },
    { 60.0, 35.0, 4.0 });
  Object object;
  object.AddQuad({ -30.0, 10.0, -15.0 }, { 80.0, -22.0, 3.0 }, { -6.0, 1.0, 30.0 });
  object.AddQuad({ -25.0, -25.0, -30.0 }, { 60.0, 3.0, 0.0 }, { 0.0, -8.0, 50.0 });
  object.Map(solver, Tolerance);
  const Comparison result = Compare(solver, object, 4000, 33);
  EXPECT_GT(result.Hits, 500);
  EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays;
  RecordProperty("hits", result.Hits);
  RecordProperty("off", result.Off);
  RecordProperty("wrong", result.Wrong);
  RecordProperty("rays", result.Rays);
}

//------------------------------------------------------------------------------
// A ball: the first surface has a silhouette. The object is in front of it, in it and behind it.
TEST(RefractionStackCells, BallShowsTrianglesBeforeWithinAndBehindIt)
{
  StackSolver solver;
  const auto ball = MakeSurface(MakeSphere(glm::dvec3(0.0), 40.0, 3, true));
  SetStack(solver, { { ball, { 1.0, 1.5 } }, { ball, { 1.0, 1.5 } } }, { 4.0, 200.0, -3.0 });
  Object object;
  object.AddTriangle({ -20.0, 60.0, -5.0 }, { 15.0, -10.0, 20.0 }, { 20.0, -120.0, -15.0 });
  object.AddQuad({ -60.0, -100.0, -60.0 }, { 120.0, 5.0, 0.0 }, { 0.0, -8.0, 120.0 });
  object.Map(solver, Tolerance);
  const Comparison result = Compare(solver, object, 8000, 34);
  EXPECT_GT(result.Hits, 1000);
  // At the rim, details are finer than the smallest cells.
  EXPECT_LE(result.Wrong, result.Rays / 1000) << "of " << result.Rays;
  RecordProperty("hits", result.Hits);
  RecordProperty("off", result.Off);
  RecordProperty("wrong", result.Wrong);
  RecordProperty("rays", result.Rays);
}

//------------------------------------------------------------------------------
// Cylinders behind waves and a pane: on their silhouettes, triangles are seen edge-on, where the
// ray's cosine with the triangle changes its sign within a cell.
TEST(RefractionStackCells, TrianglesSeenEdgeOnAreCoveredAsOtherRaysAre)
{
  const auto waves = MakeSurface(MakeWaves(100.0, 0.0, 0.9, 6.0, 16));
  const auto top = MakeSurface(MakePlane(-20.0, 140.0, 9));
  const auto bottom = MakeSurface(MakePlane(-24.0, 140.0, 9));
  Object object;
  constexpr int around = 96;
  for (const glm::dvec3& foot : { glm::dvec3(12.0, -60.0, 8.0), glm::dvec3(-15.0, -60.0, -5.0) })
  {
    std::array<glm::dvec3, around + 1> ring;
    for (int i = 0; i <= around; ++i)
    {
      const double angle = 2.0 * Pi * i / around;
      ring[static_cast<std::size_t>(i)] =
        foot + 6.0 * glm::dvec3(std::cos(angle), 0.0, std::sin(angle));
    }
    const glm::dvec3 up(0.0, 30.0, 0.0);
    for (std::size_t i = 0; i < around; ++i)
    {
      object.AddQuad(ring[i], ring[i + 1] - ring[i], up);
      object.AddTriangle(ring[0] + up, ring[i] + up, ring[i + 1] + up);
    }
  }
  for (int i = 0; i < 2; ++i)
  {
    StackSolver solver;
    SetStack(solver,
      { { waves, { 1.0, 1.333 } }, { top, { 1.333, 1.52 } }, { bottom, { 1.52, 1.0 } } },
      { 10.0 - 7.0 * i, 140.0 - 10.0 * i, -60.0 + 11.0 * i });
    Object seen = object;
    seen.Map(solver, Tolerance);
    ExpectExactPoints(solver, seen, 1e-6);
    if (i == 0)
    {
      const Comparison result = Compare(solver, seen, 6000, 36);
      EXPECT_GT(result.Hits, 200);
      EXPECT_LE(result.Wrong, result.Rays / 1000) << "of " << result.Rays;
    }
  }
}

//------------------------------------------------------------------------------
// Small triangles, most of which are seen once and are nearly straight: those keep their corners.
// Together with the divided ones they cover every ray as often as it meets them.
TEST(RefractionStackCells, TrianglesThatKeepTheirCornersAreDrawnWell)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 1.0, 6.0, 24)), { 1.0, 1.5 } },
      { MakeSurface(MakeWaves(100.0, -12.0, 0.8, 7.0, 28)), { 1.5, 1.2 } } },
    { 5.0, 90.0, -8.0 });
  Object object;
  constexpr int cells = 16;
  constexpr double side = 50.0 / cells;
  for (int i = 0; i < cells; ++i)
  {
    for (int j = 0; j < cells; ++j)
    {
      object.AddQuad({ -25.0 + side * i, -100.0 + 0.5 * i, -25.0 + side * j }, { side, 0.5, 0.0 },
        { 0.0, 0.0, side });
    }
  }
  object.Map(solver, Tolerance);
  EXPECT_GT(object.Report.Whole, object.GetCount() / 10);
  EXPECT_GT(object.Report.Mapped, object.GetCount() / 10);
  const Comparison result = Compare(solver, object, 9000, 35);
  EXPECT_GT(result.Hits, 500);
  EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays;
  RecordProperty("hits", result.Hits);
  RecordProperty("off", result.Off);
  RecordProperty("whole", static_cast<int>(object.Report.Whole));
}

//------------------------------------------------------------------------------
// The second surface has a gap, through which nothing is seen. A triangle behind it, whose corners
// are seen once each and whose image is straight, is cut all the same.
TEST(RefractionStackCells, TriangleBehindAGapIsCut)
{
  MembraneMesh halves = MakePlane(-20.0, 60.0, 6);
  halves.Translate({ 31.0, 0.0, 0.0 });
  MembraneMesh other = MakePlane(-20.0, 60.0, 6);
  other.Translate({ -31.0, 0.0, 0.0 });
  const auto first = static_cast<std::int64_t>(halves.Points.size() / 3);
  halves.Points.insert(halves.Points.end(), other.Points.begin(), other.Points.end());
  halves.Normals.insert(halves.Normals.end(), other.Normals.begin(), other.Normals.end());
  for (const std::int64_t vertex : other.Triangles)
  {
    halves.Triangles.push_back(first + vertex);
  }
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 40.0, 12)), { 1.0, 1.5 } },
      { MakeSurface(halves), { 1.5, 1.333 } } },
    { 0.0, 80.0, 0.0 });
  Object object;
  object.AddTriangle({ -5.0, -60.0, -4.0 }, { 5.0, -60.0, -4.0 }, { 5.0, -60.0, 6.0 });
  object.Map(solver, Tolerance);
  EXPECT_EQ(object.PointImages.size(), 3u);
  EXPECT_EQ(object.Report.Mapped, 1u);
  const Comparison result = Compare(solver, object, 20000, 36);
  EXPECT_GT(result.Hits, 100);
  EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays;
}
