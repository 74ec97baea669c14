// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Objects that touch surfaces of a list, and rays that lie in their planes. Truth: rays that are
// traced one by one, and the object itself.
#include "RefractionTestRandom.h"
#include "StackCellScene.h"
#include "StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

// Walls with a side on a plane interface, in front of it and behind it, sails that touch it with
// one corner, turned and rounded to `digits` binary digits together with the interfaces.
struct TouchingScene
{
  StackSolver Solver;
  Object Shapes;

  TouchingScene(double height, const glm::dvec3& eye, double angle, double digits)
  {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto turn = [=](const glm::dvec3& p)
    {
      const glm::dvec3 first(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
      const glm::dvec3 turned(first.x, c * first.y - s * first.z, s * first.y + c * first.z);
      return glm::round(turned * std::exp2(digits)) / std::exp2(digits);
    };
    std::vector<MembraneMesh> planes{ MakePlane(0.0, 200.0, 8), MakePlane(-20.0, 200.0, 6) };
    for (MembraneMesh& plane : planes)
    {
      for (std::vector<double>* vectors : { &plane.Points, &plane.Normals })
      {
        for (std::size_t i = 0; i < vectors->size(); i += 3)
        {
          double* p = vectors->data() + i;
          const glm::dvec3 turned = turn({ p[0], p[1], p[2] });
          std::copy(&turned.x, &turned.x + 3, p);
        }
      }
    }
    SetStack(this->Solver,
      { { MakeSurface(planes[0]), { 1.0, 1.5 } }, { MakeSurface(planes[1]), { 1.5, 1.333 } } },
      turn(eye));
    Object& o = this->Shapes;
    const double h = height;
    o.AddQuad({ -30.0, h, -20.0 }, { 55.0, 0.0, 3.0 }, { 5.0, -8.0, 2.0 });
    o.AddQuad({ -30.0, h, -20.0 }, { 55.0, 0.0, 3.0 }, { 1.0, 8.0, -2.0 });
    o.AddTriangle({ -20.0, h, 10.0 }, { 25.0, h, 15.0 }, { 20.0, h + 7.0, 30.0 });
    o.AddTriangle({ -20.0, h, 10.0 }, { 25.0, h, 15.0 }, { 20.0, h - 7.0, 31.0 });
    o.AddTriangle({ 30.0, h, -40.0 }, { 40.0, h + 6.0, -38.0 }, { 35.0, h + 7.0, -30.0 });
    o.AddTriangle({ 30.0, h, -40.0 }, { 40.0, h - 6.0, -38.0 }, { 35.0, h + 7.0, -30.0 });
    o.AddTriangle({ 30.0, h, -40.0 }, { 40.0, h - 6.0, -38.0 }, { 25.0, h - 7.0, -30.0 });
    for (glm::dvec3& point : o.Points)
    {
      point = turn(point);
    }
  }
};

}

//------------------------------------------------------------------------------
// Where a side runs along an interface, the interface and the side coincide up to rounding: that of
// double precision, or that of coordinates in single precision.
TEST(RefractionStackTouching, SidesOnAnInterfaceLoseNoPieces)
{
  struct
  {
    double Height;
    glm::dvec3 Eye;
    double Angle;
    double Digits;
  } const cases[] = { { 0.0, { 5.0, 80.0, -3.0 }, 0.0, 52.0 },
    { -20.0, { 31.7, 45.3, 60.1 }, 0.0, 52.0 }, { 0.0, { 31.7, 45.3, 60.1 }, 0.3, 52.0 },
    { -20.0, { 5.0, 80.0, -3.0 }, 0.3, 52.0 }, { 0.0, { 5.0, 80.0, -3.0 }, 0.3, 17.0 },
    { 0.0, { 31.7, 45.3, 60.1 }, 0.3, 17.0 }, { -20.0, { 31.7, 45.3, 60.1 }, 0.3, 17.0 } };
  for (const auto& each : cases)
  {
    TouchingScene scene(each.Height, each.Eye, each.Angle, each.Digits);
    scene.Shapes.Map(scene.Solver, Tolerance);
    const Comparison result = Compare(scene.Solver, scene.Shapes, 40000, 37);
    EXPECT_GT(result.Hits, 700);
    EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays << " at " << each.Height;
    EXPECT_EQ(scene.Solver.GetNumberOfUndecidedSearches(), 0);
    ExpectExactPoints(scene.Solver, scene.Shapes, 1e-8);
  }
}

//------------------------------------------------------------------------------
// A plate in an interface is on one side of it, and is seen once.
TEST(RefractionStackTouching, PlateInAnInterfaceIsSeenOnce)
{
  for (const std::size_t surface : { 0u, 1u })
  {
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(MakePlane(0.0, 200.0, 8)), { 1.0, 1.5 } },
        { MakeSurface(MakePlane(-20.0, 200.0, 6)), { 1.5, 1.333 } } },
      { 5.0, 80.0, -3.0 });
    const double height = surface == 0 ? 0.0 : -20.0;
    Object object;
    object.AddQuad({ -30.0, height, -20.0 }, { 55.0, 0.0, 3.0 }, { 5.0, 0.0, 41.0 });
    object.Map(solver, Tolerance);
    const std::vector<Piece> pieces = ListPieces(object, { 5.0, 80.0, -3.0 });
    Random random(41);
    for (int i = 0; i < 1000; ++i)
    {
      const double u = random(0.01, 0.99);
      const double v = random(0.01, 0.99);
      if (std::fabs(u - v) < 0.01)
      {
        continue; // next to the diagonal
      }
      const glm::dvec3 place =
        object.Points[0] + u * glm::dvec3(55.0, 0.0, 3.0) + v * glm::dvec3(5.0, 0.0, 41.0);
      const glm::dvec3 seen = SolveAlone(solver, place).Position;
      const auto covers = [&seen](const Piece& piece)
      { return Covers(piece.Corners, glm::normalize(seen - glm::dvec3(5.0, 80.0, -3.0))); };
      EXPECT_EQ(std::count_if(pieces.begin(), pieces.end(), covers), 1) << u << " " << v;
    }
  }
}

//------------------------------------------------------------------------------
// Lines on the interfaces, on both sides of them and through them are seen once from end to end.
TEST(RefractionStackTouching, LinesOnAnInterfaceAreSeenOnce)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 200.0, 8)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(-20.0, 200.0, 6)), { 1.5, 1.333 } } },
    { 5.0, 80.0, -3.0 });
  const std::vector<glm::dvec3> points{ { -30.0, 0.0, -20.0 }, { 25.0, 0.0, -17.0 },
    { 20.0, -20.0, 10.0 }, { -31.0, -20.0, 11.0 }, { 10.0, 8.0, 0.0 }, { 15.0, -55.0, 12.0 } };
  const std::int64_t offsets[] = { 0, 2, 4, 6 };
  const std::int64_t connectivity[] = { 0, 1, 2, 3, 4, 5 };
  const std::int64_t names[] = { 0, 1, 2 };
  StackImages images(solver);
  images.SetPoints(&points[0].x, points.size());
  images.SolvePoints(0, points.size());
  images.FinishPoints();
  images.SetTolerance(Tolerance);
  ImageMesh pieces;
  ImageMesh whole;
  images.MapLines({ offsets, connectivity }, names, 0, 3, pieces, whole);
  double seen[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < pieces.GetNumberOfCells(); ++i)
  {
    double place[2];
    for (std::size_t k = 0; k < 2; ++k)
    {
      const ImagePoint& image =
        pieces.Points[static_cast<std::size_t>(pieces.Connectivity[2 * i + k])];
      place[k] = 0.0;
      for (std::size_t j = 0; j < image.GetNumberOfSources(); ++j)
      {
        place[k] += image.Source[j] % 2 == 1 ? image.Weight[j] : 0.0;
      }
    }
    seen[pieces.SourceCells[i]] += std::fabs(place[1] - place[0]);
  }
  for (const std::int64_t cell : whole.SourceCells)
  {
    seen[cell] += 1.0;
  }
  for (const double length : seen)
  {
    EXPECT_NEAR(length, 1.0, 1e-10);
  }
}

//------------------------------------------------------------------------------
// The plane of each triangle contains the last ray of a vertex of the first surface, which is a
// corner of cells: there all constraints of the triangle vanish up to rounding. No piece next to it
// ends at a surface behind the last one.
TEST(RefractionStackTouching, TrianglesInThePlaneOfARayAreCoveredAsOtherRaysAre)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 0.9, 6.0, 8)), { 1.0, 1.333 } },
      { MakeSurface(MakePlane(-20.0, 140.0, 5)), { 1.333, 1.0 } } },
    { 10.0, 140.0, -60.0 });
  const RefractionStack& stack = solver.GetStack();
  const auto facets =
    static_cast<std::int32_t>(stack.GetLinks()[0].Surface->GetMembrane().GetFacets().size());
  Object object;
  Random random(42);
  for (std::int32_t facet = 0; facet < facets; ++facet)
  {
    StackPath path;
    if (stack.Trace({ facet, glm::dvec2(0.0) }, 2, false, path) != PathEnd::Passed)
    {
      continue;
    }
    const meniscus::RayJet& ray = path.GetLast();
    const glm::dvec3 origin = ray.Origin + stack.GetOrigin();
    for (int i = 0; i < 4; ++i)
    {
      const glm::dvec3 across = glm::normalize(glm::cross(
        ray.Direction, glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0))));
      object.AddTriangle(origin + 20.0 * ray.Direction + random(-3.0, 3.0) * across,
        origin + 40.0 * ray.Direction + random(-3.0, 3.0) * across,
        origin + 30.0 * ray.Direction + random(-3.0, 3.0) * across);
    }
  }
  object.Map(solver, Tolerance);
  EXPECT_GT(object.Report.Mapped, 100u);
  const Comparison result = Compare(solver, object, 2000, 43);
  EXPECT_GT(result.Rays, 500);
  // Pieces whose corners contradict each other are left out, and counted; here they are narrow.
  EXPECT_LE(result.Wrong, solver.GetNumberOfNarrowParts()) << "of " << result.Rays;
  EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
}

//------------------------------------------------------------------------------
// A ball in both sides of a pane. Where it is seen edge-on next to a side, the error of the sheet's
// rays moves corners far along the triangles; no piece may be left out there.
TEST(RefractionStackTouching, BallInAPaneLosesNoPieces)
{
  struct Ball
  {
    double Height;
    int Rings;
  };
  for (const Ball& ball : { Ball{ 0.0, 31 }, Ball{ -0.02, 31 }, Ball{ 0.05, 48 } })
  {
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(MakePlane(0.0, 6.0, 10)), { 1.0, 1.5 } },
        { MakeSurface(MakePlane(-0.1, 6.0, 10)), { 1.5, 1.333 } } },
      { 0.3, 2.0, 2.0 });
    Object object;
    const int around = 2 * ball.Rings;
    const auto place = [&ball, around](int ring, int k)
    {
      const double polar = std::acos(-1.0) * ring / ball.Rings;
      const double turn = 2.0 * std::acos(-1.0) * (k % around) / around;
      return glm::dvec3(0.013, ball.Height, 0.0) +
        0.4 *
        glm::dvec3(
          std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn));
    };
    for (const auto& [ring, k] : Product(ball.Rings, around))
    {
      if (ring + 1 < ball.Rings)
      {
        object.AddTriangle(place(ring, k), place(ring + 1, k), place(ring + 1, k + 1));
      }
      if (ring > 0)
      {
        object.AddTriangle(place(ring, k), place(ring + 1, k + 1), place(ring, k + 1));
      }
    }
    // The filter's default.
    object.Map(solver, 0.005 * std::acos(-1.0) / 180.0);
    EXPECT_GT(object.Report.Mapped, 100u);
    EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0) << ball.Height;
  }
}
