// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Normals that a membrane computes, joins at coincident vertices, and replaces.
#include "MembraneMeshes.h"
#include "Refraction/Membrane/Membrane.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using meniscus::reference::MembraneMesh;
using namespace meniscus::test;

glm::dvec3 Load(const std::vector<double>& array, std::int64_t index)
{
  const auto i = 3 * static_cast<std::size_t>(index);
  return { array[i], array[i + 1], array[i + 2] };
}

glm::dvec3 NormalOfFacet(const MembraneMesh& mesh, std::size_t facet)
{
  const std::int64_t* ids = mesh.Triangles.data() + 3 * facet;
  const glm::dvec3 first = Load(mesh.Points, ids[0]);
  return glm::normalize(
    glm::cross(Load(mesh.Points, ids[1]) - first, Load(mesh.Points, ids[2]) - first));
}

/** The mesh with three vertices of its own for each facet, which have the facet's normal. */
MembraneMesh Separate(const MembraneMesh& mesh)
{
  MembraneMesh soup;
  for (std::size_t facet = 0; facet < mesh.GetNumberOfFacets(); ++facet)
  {
    const auto first = static_cast<std::int64_t>(3 * facet);
    for (std::size_t k = 0; k < 3; ++k)
    {
      soup.AddPoint(Load(mesh.Points, mesh.Triangles[3 * facet + k]), NormalOfFacet(mesh, facet));
    }
    soup.AddTriangle(first, first + 1, first + 2);
  }
  return soup;
}

/** Errors of computed normals, in radians. */
struct NormalErrors
{
  double Inside = 0.0;
  double AtBorder = 0.0;
};

NormalErrors MeasureSquare(const MembraneMesh& mesh, int cells)
{
  Membrane membrane;
  EXPECT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  NormalErrors errors;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    const auto v = static_cast<std::size_t>(j * (cells + 1) + i);
    const double error =
      glm::length(membrane.GetNormals()[v] - Load(mesh.Normals, static_cast<std::int64_t>(v)));
    const bool isAtBorder = i == 0 || j == 0 || i == cells || j == cells;
    double& worst = isAtBorder ? errors.AtBorder : errors.Inside;
    worst = std::max(worst, error);
  }
  return errors;
}

TEST(RefractionNormals, AreExactOnClosedSpheresOfAnyFacets)
{
  for (const int resolution : { 8, 24, 68 })
  {
    const MembraneMesh mesh = meniscus::reference::MakeSphere(resolution, 1.0);
    Membrane membrane;
    ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
    double worst = 0.0;
    for (std::size_t i = 0; i < membrane.GetNormals().size(); ++i)
    {
      // The facets are wound inwards.
      worst = std::max(worst,
        glm::length(membrane.GetNormals()[i] + Load(mesh.Normals, static_cast<std::int64_t>(i))));
    }
    EXPECT_LT(worst, 1e-12) << resolution;
  }
}

TEST(RefractionNormals, OfTheBorderAreOfSecondOrder)
{
  for (const double waves : { 0.0, 3.0 })
  {
    double coarse = 0.0;
    for (const int cells : { 32, 64, 128 })
    {
      const MembraneMesh mesh = waves > 0.0
        ? meniscus::reference::MakeWaves(1.0, cells, 0.03, waves)
        : meniscus::reference::MakeSquare(1.0, cells, 2.0);
      const NormalErrors errors = MeasureSquare(mesh, cells);
      // Half the size, a quarter of the error; first order would be half.
      EXPECT_LT(errors.AtBorder, coarse > 0.0 ? 0.3 * coarse : 0.15) << waves << " " << cells;
      EXPECT_LT(errors.Inside, waves > 0.0 ? 0.5 * errors.AtBorder : 1e-13) << cells;
      coarse = errors.AtBorder;
    }
  }
}

// Noise of the heights turns each facet; continued normals must not amplify it much.
TEST(RefractionNormals, OfANoisyBorderStayNearThoseInside)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(1.0, 64, 0.0);
  std::mt19937 random(5);
  for (std::size_t i = 1; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += 1e-3 * (0x1p-31 * static_cast<double>(random()) - 1.0);
  }
  const NormalErrors errors = MeasureSquare(mesh, 64);
  EXPECT_LT(errors.AtBorder, 4.0 * errors.Inside);
}

// A facet that is smaller than its distance from another by more than the range of a double
// squared.
TEST(RefractionNormals, OfFacetsOfVeryDifferentSizesHaveUnitLength)
{
  for (const double far : { 1e100, 1e150, 1e250 })
  {
    MembraneMesh mesh;
    for (const double x : { -far, far })
    {
      const auto first = static_cast<std::int64_t>(mesh.Points.size() / 3);
      mesh.AddPoint({ x, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
      mesh.AddPoint({ x, 0.0, 1.0 }, { 0.0, 1.0, 0.0 });
      mesh.AddPoint({ x, 1.0, 0.0 }, { 0.0, 1.0, 0.0 });
      mesh.AddTriangle(first, first + 1, first + 2);
    }
    mesh.AddTriangle(0, 3, 1); // a long facet with corners of both
    Membrane membrane;
    ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
    for (const glm::dvec3& normal : membrane.GetNormals())
    {
      EXPECT_NEAR(glm::length(normal), 1.0, 1e-15) << far;
    }
  }
}

class SeparateFacets : public ::testing::TestWithParam<bool>
{
};

// A triangle soup is the surface that has the corners in common, with or without facet normals.
TEST_P(SeparateFacets, AreJoinedToASmoothSurface)
{
  const MembraneMesh mesh = meniscus::reference::MakeWaves(1.0, 24, 0.03, 2.0);
  Membrane expected;
  ASSERT_EQ(expected.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  const MembraneMesh soup = Separate(mesh);
  Membrane membrane;
  ASSERT_EQ(membrane.Build(soup.AsInput(GetParam())), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetPieces().Count, 1);
  EXPECT_EQ(membrane.GetReport().JoinedVertices, (soup.Points.size() - mesh.Points.size()) / 3);
  EXPECT_EQ(membrane.GetReport().WildNormals, 0u);
  ASSERT_EQ(membrane.GetFacets().size(), expected.GetFacets().size());
  for (const auto& [f, k] :
    Product(Below<std::size_t>(membrane.GetFacets().size()), Below<std::size_t>(3)))
  {
    const auto a = static_cast<std::size_t>(membrane.GetFacets()[f][k]);
    const auto b = static_cast<std::size_t>(expected.GetFacets()[f][k]);
    EXPECT_LT(glm::length(membrane.GetNormals()[a] - expected.GetNormals()[b]), 1e-12);
  }
  // The joined surface stays when it is built again, as a moving one is.
  ASSERT_EQ(membrane.Build(soup.AsInput(GetParam())), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetPieces().Count, 1);
}

/** A cube of 24 vertices and their faces' normals. */
MembraneMesh MakeCube()
{
  MembraneMesh mesh;
  for (const auto& [axis, side] : Product(3, List(-1.0, 1.0)))
  {
    glm::dvec3 normal(0.0);
    normal[axis] = side;
    glm::dvec3 u(0.0);
    u[(axis + 1) % 3] = side;
    glm::dvec3 v(0.0);
    v[(axis + 2) % 3] = 1.0;
    const auto first = static_cast<std::int64_t>(mesh.Points.size() / 3);
    mesh.AddPoint(normal - u - v, normal);
    mesh.AddPoint(normal + u - v, normal);
    mesh.AddPoint(normal + u + v, normal);
    mesh.AddPoint(normal - u + v, normal);
    mesh.AddTriangle(first, first + 1, first + 2);
    mesh.AddTriangle(first, first + 2, first + 3);
  }
  return mesh;
}

TEST_P(SeparateFacets, KeepCreases)
{
  for (const bool isSoup : { false, true })
  {
    const MembraneMesh cube = isSoup ? Separate(MakeCube()) : MakeCube();
    Membrane membrane;
    ASSERT_EQ(membrane.Build(cube.AsInput(GetParam())), MembraneStatus::Ready);
    ASSERT_EQ(membrane.GetFacets().size(), 12u);
    EXPECT_EQ(membrane.GetPieces().Count, 6);
    for (std::size_t f = 0; f < 12; ++f)
    {
      for (const std::int32_t vertex : membrane.GetFacets()[f])
      {
        EXPECT_LT(glm::length(membrane.GetNormals()[static_cast<std::size_t>(vertex)] -
                    NormalOfFacet(cube, f)),
          1e-15);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RefractionNormals, SeparateFacets, ::testing::Values(false, true),
  [](const auto& which) { return which.param ? "WithNormals" : "WithoutNormals"; });

// Vertices that differ in their normals only, as along the seam of a texture, are one.
TEST(RefractionNormals, SeamsOfEqualNormalsAreJoinedAndKept)
{
  MembraneMesh mesh = meniscus::reference::MakeWaves(1.0, 8, 0.03, 1.0);
  MembraneMesh soup = Separate(mesh);
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const glm::dvec3 normal = Load(mesh.Normals, mesh.Triangles[i]);
    std::copy(&normal.x, &normal.x + 3, soup.Normals.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  Membrane membrane;
  ASSERT_EQ(membrane.Build(soup.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetPieces().Count, 1);
  EXPECT_EQ(membrane.GetReport().ComputedNormals, 0u);
  for (std::size_t f = 0; f < membrane.GetFacets().size(); ++f)
  {
    const glm::dvec3& normal =
      membrane.GetNormals()[static_cast<std::size_t>(membrane.GetFacets()[f][0])];
    EXPECT_LT(glm::length(normal - Load(mesh.Normals, mesh.Triangles[3 * f])), 1e-15);
  }
}

// Two squares that touch along an edge and a third on the same edge: nothing says which to join.
TEST(RefractionNormals, EdgesOfThreeSeparateFacetsAreNotJoined)
{
  MembraneMesh mesh;
  for (const glm::dvec3& tip :
    { glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.1, -1.0) })
  {
    const auto first = static_cast<std::int64_t>(mesh.Points.size() / 3);
    mesh.AddPoint({ 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
    mesh.AddPoint({ 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
    mesh.AddPoint(tip, { 0.0, 1.0, 0.0 });
    mesh.AddTriangle(first, first + 1, first + 2);
  }
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().JoinedVertices, 0u);
}

TEST(RefractionNormals, WildNormalsAreReplacedAndCounted)
{
  MembraneMesh mesh = meniscus::reference::MakeWaves(1.0, 40, 0.03, 2.0);
  const std::size_t points = mesh.Points.size() / 3;
  std::vector<std::size_t> wild;
  for (std::size_t i = 0; i < points; i += 97)
  {
    wild.push_back(i);
    const glm::dvec3 normal =
      glm::normalize(Load(mesh.Normals, static_cast<std::int64_t>(i)) + glm::dvec3(1.0, 0.0, 0.3));
    std::copy(&normal.x, &normal.x + 3, mesh.Normals.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  const MembraneMesh exact = meniscus::reference::MakeWaves(1.0, 40, 0.03, 2.0);
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().WildNormals, wild.size());
  for (std::size_t i = 0; i < points; ++i)
  {
    EXPECT_LT(
      glm::length(membrane.GetNormals()[i] - Load(exact.Normals, static_cast<std::int64_t>(i))),
      0.03)
      << i;
  }
}

// A spherical cap, a square grid drawn to a disc: at two corners of the grid the only facet is a
// sliver along the rim, at right angles to the axis, while the surface leans by 45 degrees. Its two
// neighbours are nearly in one line and say nothing about the slope across it.
TEST(RefractionNormals, ExactNormalsAtSliversOfARimAreNotWild)
{
  constexpr int cells = 50;
  const double rim = std::sqrt(0.5);
  MembraneMesh cap;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    const glm::dvec2 place(2.0 * i / cells - 1.0, 2.0 * j / cells - 1.0);
    const double r = rim * std::max(std::fabs(place.x), std::fabs(place.y));
    const glm::dvec2 at = r > 0.0 ? r / glm::length(place) * place : place;
    const glm::dvec3 point(at.x, std::sqrt(1.0 - r * r), at.y);
    cap.AddPoint(point, point);
  }
  for (const auto& [j, i] : Product(Below<std::int64_t>(cells), Below<std::int64_t>(cells)))
  {
    const std::int64_t a = j * (cells + 1) + i;
    cap.AddTriangle(a, a + cells + 1, a + 1);
    cap.AddTriangle(a + 1, a + cells + 1, a + cells + 2);
  }
  Membrane membrane;
  ASSERT_EQ(membrane.Build(cap.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().WildNormals, 0u);
  for (std::size_t i = 0; i < membrane.GetNormals().size(); ++i)
  {
    EXPECT_LT(
      glm::length(membrane.GetNormals()[i] - Load(cap.Normals, static_cast<std::int64_t>(i))),
      1e-12);
  }
}

// A wall of water whose exact normals turn within one coarse facet, and a ridge whose normals are
// the means of both sides.
TEST(RefractionNormals, SteepAndCreasedNormalsAreNotWild)
{
  MembraneMesh steep;
  MembraneMesh ridge;
  constexpr int columns = 5;
  for (const auto& [j, i] : Product(2, columns))
  {
    // A quarter of a circle in three steps of 30 degrees, then flat.
    const double angle = std::acos(-1.0) / 6.0 * std::min(i, 3);
    const glm::dvec3 normal(std::cos(angle), std::sin(angle), 0.0);
    steep.AddPoint(glm::dvec3(std::max(0, i - 3) + 1.0 - normal.x, 1.0 - normal.y, j), normal);
    const double slope = i == columns / 2 ? 0.0 : (i < columns / 2 ? -1.0 : 1.0);
    ridge.AddPoint(
      glm::dvec3(i, -std::abs(i - columns / 2), j), glm::normalize(glm::dvec3(slope, 1.0, 0.0)));
  }
  for (MembraneMesh* mesh : { &steep, &ridge })
  {
    for (std::int64_t i = 0; i + 1 < columns; ++i)
    {
      mesh->AddTriangle(i, i + columns, i + 1);
      mesh->AddTriangle(i + 1, i + columns, i + columns + 1);
    }
    Membrane membrane;
    ASSERT_EQ(membrane.Build(mesh->AsInput()), MembraneStatus::Ready);
    EXPECT_EQ(membrane.GetReport().WildNormals, 0u);
  }
}

}
