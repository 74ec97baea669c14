// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Regions in which points have at most one image, compared with a search for all images; cells
// divided there.
#include "HeightField.h"
#include "ReadySolver.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Curved/InjectivityGrid.h"
#include "Refraction/Images/EdgeSubdivision.h"
#include "Refraction/Membrane/HeightField.h"
#include "RefractionTestRandom.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using meniscus::test::Product;
using meniscus::test::Random;
using meniscus::test::ReadySolver;

constexpr double Pi = 3.14159265358979323846;

InjectivityGrid Build(const CurvedMembraneSolver& geometry, double low, double high)
{
  InjectivityGrid unique;
  unique.Build(geometry.GetMembrane(), geometry.GetPatches(), geometry.GetFrame(),
    geometry.HasConvexField(), geometry.GetLargestBulge(), geometry.GetMedia(), low, high,
    meniscus::SerialLoop);
  return unique;
}

/** Random boxes: their middles are in a box, and they are cubes up to a size. */
struct RandomBoxes
{
  glm::dvec3 Low;
  glm::dvec3 High;
  double LargestHalf;
  int Count;
};

struct BoxCounts
{
  int Unique = 0;  ///< boxes reported to hold no point with several images
  int Several = 0; ///< points with several images, of five per box
};

/** Searches boxes at random points: none of one that is unique has several images. */
BoxCounts SearchBoxes(const CurvedMembraneSolver& geometry, const InjectivityGrid& unique,
  const RandomBoxes& boxes, Random random)
{
  const glm::dvec3 origin = geometry.GetMembrane().GetOrigin();
  std::vector<VirtualVertex> found;
  BoxCounts counts;
  for (int i = 0; i < boxes.Count; ++i)
  {
    const glm::dvec3 middle = random.Point(boxes.Low, boxes.High);
    const glm::dvec3 half(random(0.0, boxes.LargestHalf));
    const bool isUnique = unique.HoldsAtMostOne(middle - half - origin, middle + half - origin);
    counts.Unique += isUnique;
    for (int k = 0; k < 5; ++k)
    {
      geometry.FindImages(random.Point(middle - half, middle + half), found);
      counts.Several += found.size() > 1;
      EXPECT_TRUE(!isUnique || found.size() <= 1) << "box " << i;
    }
  }
  return counts;
}

struct UniqueCase
{
  const char* Name;
  HeightField Field;
  glm::dvec3 Eye;
  int Cells;
  double Depth;
  int LeastUnique; ///< percent
  int LeastSeveral;
};

// Exteriors of index 1. The last two focus, so that some points have several images.
const UniqueCase Cases[] = {
  { "plane", { HeightField::Shape::Waves, 200.0, 0.0, 0.04 * Pi, 1.0, 1.333 },
    { 20.0, 300.0, 10.0 }, 32, 400.0, 100, 0 },
  { "calm waves", { HeightField::Shape::Waves, 200.0, 0.5, 0.04 * Pi, 1.0, 1.333 },
    { 20.0, 300.0, 10.0 }, 32, 100.0, 95, 0 },
  { "waves", { HeightField::Shape::Waves, 200.0, 3.0, 0.04 * Pi, 1.0, 1.333 },
    { 20.0, 300.0, 10.0 }, 96, 250.0, 8, 5 },
  { "dome", { HeightField::Shape::Dome, 200.0, 30.0, 0.025, 1.0, 1.5 }, { 5.0, 400.0, 3.0 }, 64,
    300.0, 10, 2 },
};

class RefractionUnique : public ::testing::TestWithParam<UniqueCase>
{
};
}

//------------------------------------------------------------------------------
// Both facets of an edge must name it by the same number, and have the same place and normal in its
// middle, so that the ray there can be computed once.
TEST(InjectivityGrid, FacetsShareTheRaysOfTheirEdges)
{
  HeightField field;
  field.Amplitude = 4.0;
  field.K = 0.03 * Pi;
  const ReadySolver geometry(field.MakeMesh(8), { 20.0, 300.0, 10.0 });
  const CurvedPatches& patches = geometry.GetPatches();
  std::map<std::size_t, std::vector<PatchPoint>> edges;
  for (std::int32_t facet = 0; facet < static_cast<std::int32_t>(patches.GetSize()); ++facet)
  {
    for (int k = 0; k < 3; ++k)
    {
      edges[patches.FindFirstEdge(facet, k)].push_back(
        patches.GetPatch(facet).EvaluateEdge(k, 0.5, 0.5));
    }
  }
  int shared = 0;
  for (const auto& [number, middles] : edges)
  {
    ASSERT_LE(middles.size(), 2u);
    EXPECT_EQ(middles.front().Position, middles.back().Position);
    EXPECT_EQ(middles.front().Normal, middles.back().Normal);
    shared += middles.size() == 2;
  }
  EXPECT_EQ(edges.size(), 208u); // three sides of 128 facets, and 32 at the border
  EXPECT_EQ(shared, 176);
}

//------------------------------------------------------------------------------
// Each box that is reported to hold no point with several images is searched at random points.
TEST_P(RefractionUnique, NoPointOfABoxHasSeveral)
{
  const UniqueCase& test = GetParam();
  ReadySolver geometry(test.Field.MakeMesh(test.Cells), test.Eye, 1.0, test.Field.Interior);
  geometry.PrepareField();
  ASSERT_TRUE(geometry.HasConvexField());
  const glm::dvec3 origin = geometry.GetMembrane().GetOrigin();
  const InjectivityGrid unique = Build(geometry, -test.Depth - origin.y, -40.0 - origin.y);
  constexpr int count = 500;
  const BoxCounts counts = SearchBoxes(geometry, unique,
    { { -80.0, -test.Depth + 5.0, -80.0 }, { 80.0, -45.0, 80.0 }, 4.0, count }, Random(5));
  EXPECT_GE(100 * counts.Unique, test.LeastUnique * count);
  EXPECT_GE(100 * counts.Several, test.LeastSeveral * 5 * count);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RefractionUnique, ::testing::ValuesIn(Cases));

//------------------------------------------------------------------------------
TEST(RefractionUnique, HeightsOutOfRangeAreNotTold)
{
  ReadySolver geometry(Cases[0].Field.MakeMesh(8), Cases[0].Eye);
  const InjectivityGrid unique = Build(geometry, -100.0, -50.0);
  EXPECT_TRUE(unique.HoldsAtMostOne({ 0.0, -100.0, 0.0 }, { 1.0, -50.0, 1.0 }));
  EXPECT_FALSE(unique.HoldsAtMostOne({ 0.0, -101.0, 0.0 }, { 1.0, -60.0, 1.0 }));
  EXPECT_FALSE(unique.HoldsAtMostOne({ 0.0, -60.0, 0.0 }, { 1.0, -49.0, 1.0 }));
  const double nan = std::nan("");
  EXPECT_FALSE(unique.HoldsAtMostOne(glm::dvec3(nan), glm::dvec3(nan)));
  EXPECT_FALSE(InjectivityGrid().HoldsAtMostOne(glm::dvec3(0.0), glm::dvec3(0.0)));
}

//------------------------------------------------------------------------------
// Objects in similar depths have one grid, which does not depend on the order of requests.
TEST(RefractionUnique, ObjectsInSimilarDepthsShareAGrid)
{
  const UniqueCase& waves = Cases[2];
  const MembraneMesh mesh = waves.Field.MakeMesh(waves.Cells);
  ReadySolver first(mesh, waves.Eye);
  ReadySolver second(mesh, waves.Eye);
  first.PrepareField();
  second.PrepareField();
  const auto prepare = [](CurvedMembraneSolver& geometry, double height)
  {
    const double origin = geometry.GetFrame().GetHeight(geometry.GetMembrane().GetOrigin());
    return &geometry.PrepareGrid(height - origin, meniscus::SerialLoop);
  };
  const InjectivityGrid* shallow = prepare(first, -130.0);
  EXPECT_EQ(prepare(first, -180.0), shallow);
  const InjectivityGrid* deep = prepare(first, -400.0);
  EXPECT_NE(deep, shallow);
  EXPECT_EQ(prepare(first, -130.0), shallow);
  const InjectivityGrid* deepOfSecond = prepare(second, -400.0);
  const InjectivityGrid* shallowOfSecond = prepare(second, -180.0);
  Random random(7);
  const glm::dvec3 origin = first.GetMembrane().GetOrigin();
  int unique = 0;
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 low =
      random.Point(glm::dvec3(-80.0, -178.0, -80.0), glm::dvec3(80.0, -45.0, 80.0)) - origin;
    const glm::dvec3 high = low + glm::dvec3(random(0.0, 2.0));
    unique += shallow->HoldsAtMostOne(low, high);
    EXPECT_EQ(shallow->HoldsAtMostOne(low, high), shallowOfSecond->HoldsAtMostOne(low, high));
    EXPECT_EQ(deep->HoldsAtMostOne(low, high), deepOfSecond->HoldsAtMostOne(low, high));
  }
  EXPECT_GT(unique, 50);
  EXPECT_LT(unique, 450);
}

// A new eye needs a new grid.
TEST(RefractionUnique, GridsBelongToTheirEye)
{
  const UniqueCase& waves = Cases[2];
  const MembraneMesh mesh = waves.Field.MakeMesh(waves.Cells);
  const glm::dvec3 eyes[2] = { waves.Eye, { 150.0, 120.0, 10.0 } };
  ReadySolver moved(mesh, eyes[0]);
  moved.PrepareField();
  moved.PrepareGrid(-220.0, meniscus::SerialLoop);
  ASSERT_EQ(moved.SetEye(eyes[1], 1.0, 1.333), EyeStatus::Ready);
  ReadySolver fresh(mesh, eyes[1]);
  fresh.PrepareField();
  const InjectivityGrid& found = moved.PrepareGrid(-220.0, meniscus::SerialLoop);
  const InjectivityGrid& expected = fresh.PrepareGrid(-220.0, meniscus::SerialLoop);
  ReadySolver before(mesh, eyes[0]);
  before.PrepareField();
  const InjectivityGrid& old = before.PrepareGrid(-220.0, meniscus::SerialLoop);
  Random random(11);
  int different = 0;
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 low =
      random.Point(glm::dvec3(-80.0, -200.0, -80.0), glm::dvec3(80.0, -45.0, 80.0));
    const glm::dvec3 high = low + glm::dvec3(random(0.0, 2.0));
    EXPECT_EQ(found.HoldsAtMostOne(low, high), expected.HoldsAtMostOne(low, high));
    different += found.HoldsAtMostOne(low, high) != old.HoldsAtMostOne(low, high);
  }
  EXPECT_GT(different, 10);
}

//------------------------------------------------------------------------------
// A sheet of triangles, given by rows of heights over a grid, with holes.
namespace
{

MembraneMesh MakeSheet(int cells, const std::function<glm::dvec3(int, int)>& point,
  const std::function<bool(int, int)>& isThere)
{
  MembraneMesh mesh;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    const glm::dvec3 p = point(i, j);
    mesh.Points.insert(mesh.Points.end(), { p.x, p.y, p.z });
  }
  const auto id = [cells](int i, int j) { return static_cast<std::int64_t>(j * (cells + 1) + i); };
  for (const auto& [j, i] : Product(cells, cells))
  {
    if (isThere(i, j))
    {
      mesh.Triangles.insert(mesh.Triangles.end(),
        { id(i, j), id(i, j + 1), id(i + 1, j), id(i + 1, j), id(i, j + 1), id(i + 1, j + 1) });
    }
  }
  return mesh;
}

bool IsConvex(const MembraneMesh& mesh)
{
  CurvedMembraneSolver geometry;
  EXPECT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_FALSE(geometry.HasConvexField()); // not determined yet
  geometry.PrepareField();
  return geometry.HasConvexField();
}

const auto Everywhere = [](int, int) { return true; };
const auto Flat = [](int i, int j) { return glm::dvec3(i, 0.0, j); };

}

TEST(RefractionHeightField, OnlyAConvexSheetWithoutHolesIsOne)
{
  EXPECT_TRUE(IsConvex(MakeSheet(4, Flat, Everywhere)));
  // Rotated and translated: sides of the border are collinear up to rounding only.
  const auto turned = [](int i, int j)
  {
    const glm::dvec3 u = glm::normalize(glm::dvec3(1.0, 0.3, -0.2));
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(0.1, 1.0, 0.7)));
    return 1e5 + (0.1 * i) * u + (0.1 * j) * v;
  };
  EXPECT_TRUE(IsConvex(MakeSheet(9, turned, Everywhere)));
  EXPECT_FALSE(IsConvex(MakeSheet(4, Flat, [](int i, int j) { return i != 1 || j != 1; }))); // hole
  EXPECT_FALSE(IsConvex(MakeSheet(4, Flat, [](int i, int j) { return i != 3 || j != 3; }))); // L
  EXPECT_FALSE(IsConvex(MakeSheet(4, Flat, [](int i, int) { return i != 1; }))); // two pieces
  // Two squares that touch in a point.
  EXPECT_FALSE(IsConvex(MakeSheet(2, Flat, [](int i, int j) { return i == j; })));
  // Folded over itself.
  const auto folded = [](int i, int j)
  { return i < 3 ? glm::dvec3(i, 0.0, j) : glm::dvec3(5.0 - i, 0.5, j); };
  EXPECT_FALSE(IsConvex(MakeSheet(4, folded, Everywhere)));
}

//------------------------------------------------------------------------------
// Membranes that are no fields over a convex polygon, with points below them that are proved to
// have at most one image, in percent.
namespace
{

glm::dvec3 WavyPlace(int i, int j)
{
  const double x = 0.25 * i - 5.0;
  const double z = 0.25 * j - 5.0;
  return { x + 0.02 * std::sin(3.0 * z), 0.05 * std::sin(3.0 * x) * std::cos(2.0 * z), z };
}

// The part with x > 0 lies above the other and goes back over it.
glm::dvec3 OverlappingPlace(int i, int j)
{
  const double x = 0.25 * i - 5.0;
  return { x < 0.0 ? x : x - 2.0, x < 0.0 ? 0.0 : 0.5, 0.25 * j - 5.0 };
}

// Goes back under itself in between.
glm::dvec3 FoldedPlace(int i, int j)
{
  const double x = 0.25 * i - 5.0;
  return { x < -1.0 ? x : (x > 1.0 ? x - 3.0 : -0.5 * x - 1.5),
    x < -1.0 ? 0.0 : std::min(0.5, 0.25 * (x + 1.0)), 0.25 * j - 5.0 };
}

struct SheetCase
{
  const char* Name;
  glm::dvec3 (*Place)(int, int);
  bool (*IsThere)(int, int);
  int LeastUnique;
  int LeastSeveral; ///< points with several images, of those searched
};

const SheetCase Sheets[] = {
  { "WavyBorder", WavyPlace, [](int, int) { return true; }, 60, 0 },
  { "Hole", WavyPlace, [](int i, int j) { return i < 14 || i > 20 || j < 10 || j > 18; }, 40, 0 },
  { "TwoPieces", OverlappingPlace, [](int i, int) { return i != 19; }, 20, 5 },
  // Facets without refracted rays leave the slopes without bounds.
  { "Folded", FoldedPlace, [](int, int) { return true; }, 0, 5 },
};

class RefractionUniqueSheet : public ::testing::TestWithParam<SheetCase>
{
};

}

TEST_P(RefractionUniqueSheet, NoPointOfABoxHasSeveral)
{
  const SheetCase& test = GetParam();
  ReadySolver geometry(MakeSheet(40, test.Place, test.IsThere), { 0.5, 9.0, 1.0 });
  geometry.PrepareField();
  EXPECT_FALSE(geometry.HasConvexField());
  const glm::dvec3 origin = geometry.GetMembrane().GetOrigin();
  const InjectivityGrid unique = Build(geometry, -3.0 - origin.y, 0.0 - origin.y);
  constexpr int count = 400;
  const BoxCounts counts = SearchBoxes(
    geometry, unique, { { -5.0, -2.5, -5.0 }, { 5.0, -0.5, 5.0 }, 0.2, count }, Random(6));
  EXPECT_GE(100 * counts.Unique, test.LeastUnique * count);
  EXPECT_GE(100 * counts.Several, test.LeastSeveral * 5 * count);
}

INSTANTIATE_TEST_SUITE_P(Sheets, RefractionUniqueSheet, ::testing::ValuesIn(Sheets),
  [](const auto& test) { return test.param.Name; });

//------------------------------------------------------------------------------
// Triangles of a divided square lie within the tolerance of the true images, have no cracks, and
// cover the square once: areas in the object add up, and every inner edge has two triangles.
TEST(RefractionDivision, TrianglesAreStraightAndTile)
{
  const UniqueCase& test = Cases[1];
  ReadySolver geometry(test.Field.MakeMesh(test.Cells), test.Eye);
  constexpr double tolerance = 1e-4;
  const glm::dvec3 points[4] = { { -50.0, -90.0, -50.0 }, { 50.0, -90.0, -50.0 },
    { 50.0, -90.0, 50.0 }, { -50.0, -90.0, 50.0 } };
  std::vector<VirtualVertex> vertices(4);
  geometry.Solve(&points[0].x, 0, 4, vertices.data());
  ImagedPoint corners[4];
  for (std::size_t i = 0; i < 4; ++i)
  {
    ASSERT_EQ(vertices[i].State, ImageState::Found);
    corners[i] = { static_cast<std::int64_t>(i), points[i], &vertices[i] };
  }
  EdgeSubdivision division(geometry, tolerance);
  ImageMesh images;
  ASSERT_TRUE(division.AddTriangle({ corners[0], corners[1], corners[2] }, 7, images));
  ASSERT_TRUE(division.AddTriangle({ corners[0], corners[2], corners[3] }, 7, images));
  ASSERT_GT(images.GetNumberOfCells(), 100u);

  const auto place = [&points](const meniscus::ImagePoint& point)
  {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
    {
      sum += point.Weight[k] * points[point.Source[k]];
    }
    return sum;
  };
  using Key = std::tuple<double, double>;
  std::map<std::pair<Key, Key>, int> sides;
  double area = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < images.GetNumberOfCells(); ++i)
  {
    ASSERT_EQ(images.Ends[i], static_cast<std::int64_t>(3 * i + 3));
    EXPECT_EQ(images.SourceCells[i], 7);
    glm::dvec3 at[3];
    glm::dvec3 drawn(0.0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto& point = images.Points[static_cast<std::size_t>(images.Connectivity[3 * i + k])];
      at[k] = place(point);
      drawn += point.Vertex.Position / 3.0;
    }
    area += 0.5 * std::fabs(glm::cross(at[1] - at[0], at[2] - at[0]).y);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Key a(at[k].x, at[k].z);
      const Key b(at[(k + 1) % 3].x, at[(k + 1) % 3].z);
      ++sides[{ std::min(a, b), std::max(a, b) }];
    }
    const glm::dvec3 middle = (at[0] + at[1] + at[2]) / 3.0;
    VirtualVertex exact;
    geometry.Solve(&middle.x, 0, 1, &exact);
    const glm::dvec3 seen = glm::normalize(exact.Position - test.Eye);
    worst = std::max(worst, glm::length(glm::cross(seen, glm::normalize(drawn - test.Eye))));
  }
  EXPECT_NEAR(area, 1e4, 1e-6);
  // If the image is of second degree, the middle of a triangle deviates by up to 4/3 of the
  // deviation of the middles of its edges.
  EXPECT_LT(worst, 1.5 * tolerance);
  double border = 0.0;
  for (const auto& [ends, count] : sides)
  {
    const auto [a, b] = ends;
    const glm::dvec2 side(std::get<0>(b) - std::get<0>(a), std::get<1>(b) - std::get<1>(a));
    border += count == 1 ? glm::length(side) : 0.0;
    EXPECT_LE(count, 2);
  }
  EXPECT_NEAR(border, 400.0, 1e-6); // every side inside the square has its neighbour
}

//------------------------------------------------------------------------------
// A line that leaves the visible region is not divided, and no part of it remains.
TEST(RefractionDivision, NothingIsAddedWhereAnImageIsMissing)
{
  const UniqueCase& test = Cases[0];
  ReadySolver geometry(MakeSheet(
                         20, [](int i, int j) { return glm::dvec3(i - 10.0, 0.0, j - 10.0); },
                         [](int i, int) { return i < 8 || i > 11; }),
    test.Eye);
  const glm::dvec3 points[2] = { { -9.0, -2.0, 0.0 }, { 9.0, -2.0, 0.0 } };
  std::vector<VirtualVertex> vertices(2);
  geometry.Solve(&points[0].x, 0, 2, vertices.data());
  ASSERT_EQ(vertices[0].State, ImageState::Found);
  ASSERT_EQ(vertices[1].State, ImageState::Found);
  EdgeSubdivision division(geometry, 1e-4);
  ImageMesh images;
  EXPECT_FALSE(
    division.AddLine({ 0, points[0], &vertices[0] }, { 1, points[1], &vertices[1] }, 0, images));
  EXPECT_TRUE(images.Points.empty());
  EXPECT_TRUE(images.Connectivity.empty());
  EXPECT_EQ(images.GetNumberOfCells(), 0u);
}
