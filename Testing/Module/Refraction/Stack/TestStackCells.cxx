// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of triangles and lines through several surfaces. Truth: rays that are traced one by one
// and intersected with the object on each leg.
#include "StackCellScene.h"
#include "StackTestScene.h"

namespace
{

using meniscus::StackSolver;
using namespace meniscus::reference;
using namespace meniscus::test;

const double Pi = std::acos(-1.0);

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
}

//------------------------------------------------------------------------------
// The second surface is smaller than the first, and reflects the rays on one side totally: objects
// between the surfaces are seen only on rays that go on to it.
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
  for (const auto& [i, j] : Product(cells + 1, cells + 1))
  {
    object.Points.push_back({ -25.0 + side * i, -100.0 + 0.5 * i, -25.0 + side * j });
    if (i < cells && j < cells)
    {
      const std::int64_t corner = i * (cells + 1) + j;
      for (const std::int64_t k : { 0, cells + 1, cells + 2, 0, cells + 2, 1 })
      {
        object.Connectivity.push_back(corner + k);
      }
    }
  }
  object.Map(solver, Tolerance);
  EXPECT_GT(object.Report.Whole, object.GetCount() / 10);
  EXPECT_GT(object.Report.Mapped, object.GetCount() / 10);
  // With the last three seeds, a ray is wrong if pieces do not end on the sides of whole triangles.
  for (const unsigned seed : { 35u, 55u, 57u, 93u })
  {
    const Comparison result = Compare(solver, object, 9000, seed);
    EXPECT_GT(result.Hits, 500);
    EXPECT_EQ(result.Wrong, 0) << "of " << result.Rays << ", seed " << seed;
  }
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

namespace
{

/** Two flat layers below an eye at a height of 2: a sea, and a window in it at a depth of 0.5. */
struct Layers
{
  static constexpr double Height = 2.0;
  static constexpr double Window = 0.5;
  static constexpr double Floor = 1.0;

  /** Distance of a point on the floor from the eye's foot, for a sine of the sight ray. */
  static double GetReach(double sine)
  {
    const auto tangent = [](double s) { return s / std::sqrt(1.0 - s * s); };
    return Height * tangent(sine) + Window * tangent(sine / 1.333) +
      (Floor - Window) * tangent(sine / 1.5);
  }

  /** Where the eye over (0, 0) sees a point of the floor in the sea. */
  static glm::dvec2 See(const glm::dvec2& point)
  {
    const double reach = glm::length(point);
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 60; ++i)
    {
      const double sine = 0.5 * (low + high);
      (GetReach(sine) < reach ? low : high) = sine;
    }
    const double seen = Height * low / std::sqrt(1.0 - low * low);
    return reach > 0.0 ? (seen / reach) * point : point;
  }
};

/** Area in the sea, seen from `eye`, of pieces of the image that keep or lose the object's points.
 */
double GetSeenArea(const Object& object, const glm::dvec3& eye, double unit)
{
  double sum = 0.0;
  for (const Piece& piece : ListPieces(object, eye))
  {
    const auto place = [&](std::size_t k)
    {
      const glm::dvec3& way = piece.Corners[k];
      return glm::dvec2(way.x, way.z) * (-eye.y / way.y / unit);
    };
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < piece.Corners.size(); ++k)
    {
      const glm::dvec2 u = place(k) - place(0);
      const glm::dvec2 v = place(k + 1) - place(0);
      area += 0.5 * (u.x * v.y - u.y * v.x);
    }
    sum += std::fabs(area);
  }
  return sum;
}

/** A sea about the origin, of columns and rows of cells of two facets each. */
MembraneMesh MakeSea(double half, int columns, int rows)
{
  MembraneMesh mesh;
  for (const auto& [i, j] : Product(columns + 1, rows + 1))
  {
    const double x = half * (2.0 * i / columns - 1.0);
    const double z = half * (2.0 * j / rows - 1.0);
    mesh.Points.insert(mesh.Points.end(), { x, 0.0, z });
    mesh.Normals.insert(mesh.Normals.end(), { 0.0, 1.0, 0.0 });
    if (i < columns && j < rows)
    {
      const std::int64_t corner = i * (rows + 1) + j;
      for (const std::int64_t k : { 0, 1, rows + 2, 0, rows + 2, rows + 1 })
      {
        mesh.Triangles.push_back(corner + k);
      }
    }
  }
  return mesh;
}

/** A square meter of the floor, seen through the sea and the window, in units of `Unit`. */
class SeenFloor
{
public:
  static constexpr double Tolerance = 1e-4;

  explicit SeenFloor(double unit)
    : Unit(unit)
  {
    constexpr int samples = 1000;
    const glm::dvec2 corners[4] = { { -0.6, -0.5 }, { 0.4, -0.5 }, { 0.4, 0.5 }, { -0.6, 0.5 } };
    const auto at = [&corners](int k)
    {
      const double s = static_cast<double>(k % samples) / samples;
      return Layers::See((1.0 - s) * corners[k / samples % 4] + s * corners[(k / samples + 1) % 4]);
    };
    for (int i = 0; i < 4 * samples; ++i)
    {
      const glm::dvec2 a = at(i);
      const glm::dvec2 b = at(i + 1);
      this->Area += 0.5 * (a.x * b.y - a.y * b.x);
      this->Border += glm::length(b - a);
    }
  }

  /**
   * Expects the exact area and places. The sides of the image are off by the tolerance at most,
   * each way; no place of the sea is farther than 2.2 from the eye, nor seen at a cosine below 0.9.
   */
  void ExpectImage(MembraneMesh sea, const glm::dvec2& shift, double window = 4.0) const
  {
    const double unit = this->Unit;
    const glm::dvec3 eye(0.0, Layers::Height * unit, 0.0);
    sea.Translate({ shift.x, 0.0, shift.y });
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(sea), { 1.0, 1.333 } },
        { MakeSurface(MakePlane(-Layers::Window * unit, window * unit, 1)), { 1.333, 1.5 } } },
      eye);
    Object object;
    object.AddQuad(
      { -0.6 * unit, -Layers::Floor * unit, -0.5 * unit }, { unit, 0.0, 0.0 }, { 0.0, 0.0, unit });
    object.Map(solver, Tolerance);
    EXPECT_NEAR(GetSeenArea(object, eye, unit), this->Area, this->Border * Tolerance * 2.2 / 0.9);
    EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
    ExpectExactPoints(solver, object, 1e-8 * unit);
  }

private:
  double Unit;
  double Area = 0.0;
  double Border = 0.0;
};

/** Half of the width of a sea. */
class HugeSeas : public ::testing::TestWithParam<double>
{
};

}

//------------------------------------------------------------------------------
// The sea is a square of two facets. The eye sees the floor through a window, in a small part of
// the sea. The scene is repeated in other units of length.
TEST(RefractionStackCells, ImagesInHugeFacetsAreThoseInSmallOnes)
{
  for (const double unit : { 1.0, 1e-6, 1e2, 1e4, 1e6 })
  {
    const SeenFloor floor(unit);
    for (const auto& [half, shift] : Product(List(1.0, 1e2, 1e4, 1e6), List(0.1, 0.37)))
    {
      SCOPED_TRACE(::testing::Message()
        << "half width " << half << " in units of " << unit << ", shift " << shift);
      floor.ExpectImage(MakeSea(half * unit, 1, 1), half * unit * glm::dvec2(shift));
    }
  }
}

//------------------------------------------------------------------------------
// The eye is at any place over seas of 2, 8 or 200 facets, or of long ones.
TEST_P(HugeSeas, ImagesDoNotDependOnTheFacets)
{
  const double half = this->GetParam();
  const SeenFloor floor(1.0);
  struct Trial
  {
    int Columns;
    int Rows;
    glm::dvec2 Shift;
  };
  for (const Trial& trial :
    { Trial{ 1, 1, { 0.3, -0.2 } }, Trial{ 1, 1, { 0.9, 0.05 } }, Trial{ 1, 1, { 0.0, 0.3 } },
      Trial{ 1, 1, { 0.50001, -0.5 } }, Trial{ 2, 2, { 0.1, 0.1 } }, Trial{ 2, 2, { -0.77, 0.64 } },
      Trial{ 10, 10, { 0.37, 0.37 } }, Trial{ 1, 20, { -0.12, 0.45 } } })
  {
    SCOPED_TRACE(::testing::Message() << trial.Columns << " x " << trial.Rows << " cells, shift "
                                      << trial.Shift.x << ", " << trial.Shift.y);
    floor.ExpectImage(MakeSea(half, trial.Columns, trial.Rows), half * trial.Shift);
  }
}

//------------------------------------------------------------------------------
// Facets that are as wide as the view and much longer are divided into slender cells.
TEST(RefractionStackCells, ImagesInLongFacetsAreComplete)
{
  const SeenFloor floor(1.0);
  floor.ExpectImage(MakeSea(247.0, 1, 30), 247.0 * glm::dvec2(0.267, 0.059), 8e5);
  floor.ExpectImage(MakeSea(4e3, 1, 30), 4e3 * glm::dvec2(-0.603, 0.385), 6e3);
}

INSTANTIATE_TEST_SUITE_P(RefractionStackCells, HugeSeas,
  ::testing::Values(1e2, 1e3, 1e4, 1e5, 3e5, 5e5, 1e6, 2e6, 1e7),
  [](const ::testing::TestParamInfo<double>& trial)
  { return "HalfWidth" + std::to_string(static_cast<int>(trial.param)); });
