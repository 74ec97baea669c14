// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Virtual vertices against closed forms, and the tree against a loop over all facets.
#include "AnalyticMembrane.h"
#include "MembraneMeshes.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "RefractionTestRandom.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using namespace meniscus::test;
using meniscus::test::Random;
using namespace meniscus::reference;

FlatMembraneSolver Make(
  const MembraneMesh& mesh, const glm::dvec3& eye, double exterior, double interior)
{
  FlatMembraneSolver geometry;
  EXPECT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(geometry.SetEye(eye, exterior, interior), EyeStatus::Ready);
  return geometry;
}

bool Same(const VirtualVertex& a, const VirtualVertex& b)
{
  return a.Facet == b.Facet && a.State == b.State && a.Position == b.Position &&
    a.SightPoint == b.SightPoint && a.Depth == b.Depth && a.Reflectance == b.Reflectance &&
    a.Orientation == b.Orientation;
}

//------------------------------------------------------------------------------
// At the corners of a facet the thesis's method is exact: the ray through a vertex is refracted
// exactly by Snell's law.
TEST(RefractionGeometry, IsExactOnTheRaysOfTheVertices)
{
  const MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 8, 0.0);
  const glm::dvec3 eye(13.0, 310.0, -7.0);
  const FlatMembraneSolver geometry = Make(mesh, eye, 1.0, 1.333);
  const AnalyticMembrane exact{ 0.0, 1.0, 1.333 };
  for (std::size_t v = 20; v < 60; v += 3)
  {
    const glm::dvec3 s(mesh.Points[3 * v], mesh.Points[3 * v + 1], mesh.Points[3 * v + 2]);
    const auto ray = exact.Refract(glm::normalize(s - eye), s);
    ASSERT_TRUE(ray);
    const glm::dvec3 point = s + 80.0 * *ray;
    const VirtualVertex vertex = geometry.SolvePoint(point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    // Coordinates of a few hundred units, with a few dozen roundings.
    EXPECT_LT(glm::length(vertex.SightPoint - s), 1e-11);
    EXPECT_NEAR(vertex.Depth, 80.0, 1e-11);
    // Eq. 2.4 and its corollary Eq. 2.5: above the true vertex, along the normal.
    EXPECT_NEAR(glm::length(vertex.Position - s), 80.0 / 1.333, 1e-11);
    EXPECT_NEAR(vertex.Position.x, point.x, 1e-11);
    EXPECT_NEAR(vertex.Position.z, point.z, 1e-11);
    EXPECT_EQ(vertex.Orientation, 1);
    const double cosine = (eye.y - s.y) / glm::length(eye - s);
    EXPECT_NEAR(vertex.Reflectance, meniscus::FresnelReflectance(cosine, 1.0, 1.333), 1e-12);
  }
}

//------------------------------------------------------------------------------
TEST(RefractionGeometry, SightPointsConvergeToTheClosedForms)
{
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  for (const AnalyticMembrane& exact :
    { AnalyticMembrane{ 0.0, 1.0, 1.333 }, AnalyticMembrane{ 200.0, 1.0, 1.51 } })
  {
    double coarse = 0.0;
    for (const int cells : { 8, 16, 32 })
    {
      const FlatMembraneSolver geometry =
        Make(meniscus::reference::MakeSquare(200.0, cells, exact.SphereRadius), eye, exact.Exterior,
          exact.Interior);
      Random random(7);
      double worst = 0.0;
      double worstAside = 0.0;
      for (int i = 0; i < 400; ++i)
      {
        const glm::dvec3 point(random(-50.0, 50.0), random(-120.0, -20.0), random(-50.0, 50.0));
        const VirtualVertex vertex = geometry.SolvePoint(point);
        ASSERT_EQ(vertex.State, ImageState::Found);
        const auto sightPoints = exact.FindSightPoints(eye, point);
        ASSERT_EQ(sightPoints.size(), 1u);
        worst = std::max(worst, glm::length(vertex.SightPoint - sightPoints[0]));
        worstAside = std::max(
          worstAside, std::hypot(vertex.Position.x - point.x, vertex.Position.z - point.z));
      }
      // Linear interpolation of a smooth map is of second order: a factor of 4, except for the
      // sampling error.
      const double first = exact.SphereRadius > 0.0 ? 1.0 : 0.2;
      EXPECT_LT(worst, coarse > 0.0 ? coarse / 3.0 : first) << cells << " cells";
      // Eq. 2.5 is as accurate as the sight point: both ends of the segment have that error.
      if (exact.SphereRadius == 0.0)
      {
        EXPECT_LT(worstAside, 2.0 * worst);
      }
      coarse = worst;
    }
  }
}

//------------------------------------------------------------------------------
// Equal indices do not refract. On the rays of the vertices this is exact; between them the sight
// point is interpolated, and only the depth along the sight ray is exact.
TEST(RefractionGeometry, EqualIndicesAreTheIdentityOnVertexRays)
{
  const MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 8, 0.0);
  const glm::dvec3 eye(5.0, 200.0, 9.0);
  const FlatMembraneSolver geometry = Make(mesh, eye, 1.333, 1.333);
  for (std::size_t v = 0; v < 81; ++v)
  {
    const glm::dvec3 s(mesh.Points[3 * v], mesh.Points[3 * v + 1], mesh.Points[3 * v + 2]);
    const glm::dvec3 point = s + 0.3 * (s - eye);
    const VirtualVertex vertex = geometry.SolvePoint(point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    EXPECT_LT(glm::length(vertex.Position - point), 1e-11);
    EXPECT_EQ(vertex.Reflectance, 0.0);
  }
}

//------------------------------------------------------------------------------
struct BruteForceCase
{
  const char* Name;
  MembraneMesh Mesh;
  glm::dvec3 Eye;
  double Exterior;
  double Interior;
};

std::vector<BruteForceCase> MakeBruteForceCases()
{
  using namespace meniscus::reference;
  return {
    { "flat", MakeSquare(200.0, 16, 0.0), { 20.0, 300.0, 10.0 }, 1.0, 1.333 },
    { "flat, eye above a vertex", MakeSquare(200.0, 16, 0.0), { 0.0, 300.0, 0.0 }, 1.0, 1.333 },
    { "one facet pair", MakeSquare(200.0, 1, 0.0), { 20.0, 300.0, 10.0 }, 1.0, 1.333 },
    { "disc", MakeDisc(100.0, 5, 0.0), { 20.0, 30.0, 10.0 }, 1.0, 1.333 },
    { "hemisphere", MakeDisc(100.0, 6, 100.0), { 0.0, 60.0, 0.0 }, 1.0, 1.51 },
    { "hemisphere, total reflection", MakeDisc(100.0, 6, 100.0), { 0.0, 400.0, 0.0 }, 2.2, 1.0 },
    { "waves with caustics", MakeWaves(200.0, 30, 8.0, 3.0), { 20.0, 300.0, 10.0 }, 1.0, 1.333 },
    { "rough", MakeRandom(200.0, 24, 5.0, 0.5, 17), { 20.0, 200.0, 10.0 }, 1.0, 1.333 },
    { "rough, into the thinner medium", MakeRandom(200.0, 24, 20.0, 2.0, 18), { 50.0, 80.0, 10.0 },
      2.0, 1.0 },
    { "grazing eye", MakeRandom(200.0, 24, 0.5, 0.1, 19), { 400.0, 1.0, 10.0 }, 1.0, 1.333 },
    { "eye close to the surface", MakeRandom(200.0, 24, 0.01, 0.01, 20), { 1.0, 0.1, 2.0 }, 1.0,
      1.333 },
    { "eye behind", MakeRandom(200.0, 24, 1.0, 0.1, 21), { 1.0, -50.0, 2.0 }, 1.0, 1.333 },
  };
}

TEST(RefractionGeometry, TreeAgreesWithBruteForce)
{
  for (const BruteForceCase& test : MakeBruteForceCases())
  {
    const FlatMembraneSolver geometry = Make(test.Mesh, test.Eye, test.Exterior, test.Interior);
    Random random(23);
    int found = 0;
    int mirrored = 0;
    constexpr int points = 4000;
    for (int i = 0; i < points; ++i)
    {
      // A quarter of the points each: near, below, all around, far away.
      const double size = i % 4 == 0 ? 5.0 : (i % 4 == 1 ? 150.0 : (i % 4 == 2 ? 400.0 : 1e5));
      glm::dvec3 point(
        random(-size, size), random(-size, i % 4 == 1 ? 0.0 : 0.5 * size), random(-size, size));
      if (i % 8 < 2)
      {
        // On integer coordinates: walls, edges, vertices.
        point = glm::dvec3(std::round(point.x), std::round(point.y), std::round(point.z));
      }
      const VirtualVertex byTree = geometry.SolvePoint(point);
      const VirtualVertex byForce = geometry.SolvePointByBruteForce(point);
      ASSERT_TRUE(Same(byTree, byForce))
        << test.Name << ": point " << i << " (" << point.x << ", " << point.y << ", " << point.z
        << ") in facet " << byTree.Facet << " by tree, " << byForce.Facet << " by force";
      found += byTree.State == ImageState::Found;
      mirrored += byTree.Orientation < 0;
    }
    EXPECT_GT(found, points / 50) << test.Name;
    if (std::string(test.Name) == "waves with caustics")
    {
      EXPECT_GT(mirrored, 0);
    }
  }
}

TEST(RefractionGeometry, TreeAgreesOnPointsMadeForWallsAndVertices)
{
  const MembraneMesh mesh = meniscus::reference::MakeRandom(200.0, 16, 3.0, 0.3, 31);
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const FlatMembraneSolver geometry = Make(mesh, eye, 1.0, 1.333);
  Random random(37);
  int found = 0;
  for (int i = 0; i < 3000; ++i)
  {
    // On the ray through a vertex, or on the wall through an edge.
    const auto facet = static_cast<std::size_t>(random(0.0, 511.9));
    glm::dvec3 p[2];
    for (std::size_t k = 0; k < 2; ++k)
    {
      const auto v = static_cast<std::size_t>(mesh.Triangles[3 * facet + k]);
      const glm::dvec3 s(mesh.Points[3 * v], mesh.Points[3 * v + 1], mesh.Points[3 * v + 2]);
      const glm::dvec3 n(mesh.Normals[3 * v], mesh.Normals[3 * v + 1], mesh.Normals[3 * v + 2]);
      p[k] = s +
        random(0.0, 1.0) * 100.0 *
          meniscus::ComputeRefractionRay(glm::normalize(s - eye), n, 1.0 / 1.333).Direction;
    }
    const double along = i % 2 == 0 ? 0.0 : random(0.0, 1.0);
    const glm::dvec3 point = (1.0 - along) * p[0] + along * p[1];
    const VirtualVertex byTree = geometry.SolvePoint(point);
    ASSERT_TRUE(Same(byTree, geometry.SolvePointByBruteForce(point))) << "point " << i;
    found += byTree.State == ImageState::Found;
    if (i % 2 == 0)
    {
      ASSERT_EQ(byTree.State, ImageState::Found) << "lost on a vertex ray, point " << i;
    }
  }
  EXPECT_GT(found, 2500);
}

//------------------------------------------------------------------------------
TEST(RefractionGeometry, FirstFacetOfSeveralWins)
{
  // Two sheets one above the other: every point below both has two images.
  MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 4, 0.0);
  MembraneMesh upper = mesh;
  upper.Translate({ 0.0, 1.0, 0.0 });
  mesh.Points.insert(mesh.Points.end(), upper.Points.begin(), upper.Points.end());
  mesh.Normals.insert(mesh.Normals.end(), upper.Normals.begin(), upper.Normals.end());
  for (std::int64_t id : upper.Triangles)
  {
    mesh.Triangles.push_back(id + 25);
  }
  const FlatMembraneSolver geometry = Make(mesh, { 3.0, 300.0, 4.0 }, 1.0, 1.333);
  Random random(41);
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 point(random(-60.0, 60.0), random(-50.0, -5.0), random(-60.0, 60.0));
    const VirtualVertex vertex = geometry.SolvePoint(point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    EXPECT_LT(vertex.Facet, 32);
    EXPECT_FALSE(geometry.HasOneCell(point, 0.0));
  }
}

//------------------------------------------------------------------------------
// Offsets that are powers of two times the rounding of the coordinates, so that the same shape
// exists at both places; the only difference is the rounding of the sum in the result.
TEST(RefractionGeometry, OffsetCoordinatesCostNothing)
{
  MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, 16, 3.0, 2.0);
  const glm::dvec3 offset(1048576.0, -2097152.0, 4194304.0);
  const double grid = std::ldexp(1.0, -30); // exact at these offsets
  for (double& x : mesh.Points)
  {
    x = std::round(x / grid) * grid;
  }
  MembraneMesh moved = mesh;
  moved.Translate(offset);
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const FlatMembraneSolver here = Make(mesh, eye, 1.0, 1.333);
  const FlatMembraneSolver there = Make(moved, eye + offset, 1.0, 1.333);
  Random random(43);
  for (int i = 0; i < 1000; ++i)
  {
    glm::dvec3 point(random(-70.0, 70.0), random(-90.0, -10.0), random(-70.0, 70.0));
    point = glm::round(point / grid) * grid;
    const VirtualVertex a = here.SolvePoint(point);
    const VirtualVertex b = there.SolvePoint(point + offset);
    ASSERT_EQ(a.Facet, b.Facet);
    EXPECT_EQ(a.Depth, b.Depth);
    EXPECT_LT(glm::length(b.Position - offset - a.Position),
      2.0 * 4194304.0 * std::numeric_limits<double>::epsilon());
  }
}

//------------------------------------------------------------------------------
TEST(RefractionGeometry, ScalesDoNotMatter)
{
  const MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, 8, 3.0, 2.0);
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const FlatMembraneSolver geometry = Make(mesh, eye, 1.0, 1.333);
  for (const double scale : { 0x1p-60, 0x1p-20, 0x1p20, 0x1p60 })
  {
    MembraneMesh scaled = mesh;
    for (double& x : scaled.Points)
    {
      x *= scale;
    }
    const FlatMembraneSolver other = Make(scaled, scale * eye, 1.0, 1.333);
    Random random(47);
    for (int i = 0; i < 300; ++i)
    {
      const glm::dvec3 point(random(-70.0, 70.0), random(-90.0, -10.0), random(-70.0, 70.0));
      const VirtualVertex a = geometry.SolvePoint(point);
      const VirtualVertex b = other.SolvePoint(scale * point);
      ASSERT_EQ(a.Facet, b.Facet) << scale;
      EXPECT_EQ(scale * a.Position.y, b.Position.y) << scale;
    }
  }
}

//------------------------------------------------------------------------------
// Points down to the surface itself. Cells do not tile space (each has its own planes, so the
// common wall of two cells is two surfaces), and interpolation moves a shallow sight point by a
// second-order amount.
TEST(RefractionGeometry, PointsCloseToTheMembraneKeepTheirImage)
{
  for (const double depth : { 1.0, 1e-3, 1e-6, 1e-9, 0.0 })
  {
    double coarse = 0.0;
    for (const int cells : { 8, 16, 32 })
    {
      const MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, cells, 0.0);
      const FlatMembraneSolver geometry = Make(mesh, { 150.0, 60.0, 10.0 }, 1.0, 1.333);
      Random random(53);
      int lost = 0;
      double worst = 0.0;
      constexpr int points = 2000;
      for (int i = 0; i < points; ++i)
      {
        const glm::dvec3 point(random(-80.0, 80.0), -depth, random(-80.0, 80.0));
        const VirtualVertex vertex = geometry.SolvePoint(point);
        lost += vertex.State != ImageState::Found;
        worst = std::max(worst, glm::length(vertex.Position - point) - 2.0 * depth);
      }
      EXPECT_LE(lost, points / 100) << depth << " " << cells;
      EXPECT_LT(worst, coarse > 0.0 ? std::max(coarse / 3.0, 1e-9) : 2.0) << depth << " " << cells;
      coarse = worst;
    }
  }
}

TEST(RefractionGeometry, PointsInFrontHaveNoImage)
{
  const MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 8, 0.0);
  const FlatMembraneSolver geometry = Make(mesh, { 15.0, 260.0, 10.0 }, 1.0, 1.333);
  Random random(59);
  for (int i = 0; i < 300; ++i)
  {
    const glm::dvec3 point(random(-80.0, 80.0), random(1.0, 200.0), random(-80.0, 80.0));
    const VirtualVertex vertex = geometry.SolvePoint(point);
    EXPECT_EQ(vertex.State, ImageState::NoImage);
    EXPECT_EQ(vertex.Facet, -1);
    EXPECT_EQ(vertex.Position, point);
  }
}

//------------------------------------------------------------------------------
// An octahedron with normals to the outside: from any eye some facets face away.
MembraneMesh MakeOctahedron()
{
  MembraneMesh octahedron;
  for (int i = 0; i < 6; ++i)
  {
    glm::dvec3 point(0.0);
    point[i / 2] = i % 2 == 0 ? -1.0 : 1.0;
    octahedron.AddPoint(point, point);
  }
  for (const auto& [x, y] : Product(List(0, 1), List(2, 3)))
  {
    octahedron.AddTriangle(x, y, 4);
    octahedron.AddTriangle(x, y, 5);
  }
  return octahedron;
}

//------------------------------------------------------------------------------
// With equal indices all rays are straight and meet at the eye, a focus: the cross-sections of all
// cells there are as small as rounding, and have no shape. The eye is in front of all facets.
TEST(RefractionGeometry, AFocusIsInNoCell)
{
  Random random(61);
  for (int i = 0; i < 300; ++i)
  {
    const glm::dvec3 eye(random(-4.0, -1.1), random(-4.0, 4.0), random(-4.0, 4.0));
    const FlatMembraneSolver geometry = Make(MakeOctahedron(), eye, 1.0, 1.0);
    EXPECT_EQ(geometry.SolvePoint(eye).State, ImageState::NoImage) << i;
    EXPECT_EQ(geometry.SolvePointByBruteForce(eye).State, ImageState::NoImage) << i;
  }
}

//------------------------------------------------------------------------------
// Where a facet faces away, its ray is at grazing incidence (Eq. 3.1).
TEST(RefractionGeometry, CosinesAreOfAcuteAngles)
{
  const FlatMembraneSolver geometry = Make(MakeOctahedron(), { -3.0, 0.4, 0.7 }, 1.0, 1.333);
  Random random(67);
  int grazing = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const VirtualVertex vertex =
      geometry.SolvePoint({ random(0.0, 4.0), random(-2.0, 2.0), random(-2.0, 2.0) });
    ASSERT_GE(vertex.Cosine, 0.0) << i;
    ASSERT_LE(vertex.Cosine, 1.0) << i;
    ASSERT_GE(vertex.Reflectance, 0.0) << i;
    grazing += vertex.Cosine == 0.0;
    EXPECT_EQ(vertex.Reflectance == 1.0, vertex.Cosine == 0.0) << i;
  }
  EXPECT_GT(grazing, 10);
}

//------------------------------------------------------------------------------
TEST(RefractionGeometry, PointsThatAreNotFiniteSaySo)
{
  const FlatMembraneSolver geometry =
    Make(meniscus::reference::MakeSquare(200.0, 8, 0.0), { 0.0, 100.0, 0.0 }, 1.0, 1.333);
  const double bad[] = { std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 1e300 };
  for (const double value : bad)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 point(0.0, -10.0, 0.0);
      point[axis] = value;
      EXPECT_EQ(geometry.SolvePoint(point).State, ImageState::NotFinite) << value << " " << axis;
      EXPECT_EQ(geometry.SolvePointByBruteForce(point).State, ImageState::NotFinite);
    }
  }
}

TEST(RefractionGeometry, RefusesBadEyesAndIndices)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  FlatMembraneSolver geometry;
  const MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 8, 0.0);
  ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  const glm::dvec3 eye(0.0, 100.0, 0.0);
  for (const double index : { 0.0, -1.0, nan, inf, -inf })
  {
    EXPECT_EQ(geometry.SetEye(eye, index, 1.0), EyeStatus::BadIndex);
    EXPECT_EQ(geometry.SetEye(eye, 1.0, index), EyeStatus::BadIndex);
  }
  EXPECT_EQ(geometry.SetEye({ nan, 1.0, 1.0 }, 1.0, 1.3), EyeStatus::NotFinite);
  EXPECT_EQ(geometry.SetEye({ 0.0, inf, 1.0 }, 1.0, 1.3), EyeStatus::NotFinite);
  EXPECT_EQ(geometry.SetEye({ 0.0, 0.0, 0.0 }, 1.0, 1.3), EyeStatus::OnTheMembrane);  // vertex
  EXPECT_EQ(geometry.SetEye({ 12.5, 0.0, 0.0 }, 1.0, 1.3), EyeStatus::OnTheMembrane); // edge
  EXPECT_EQ(geometry.SetEye({ 7.0, 0.0, 3.0 }, 1.0, 1.3), EyeStatus::OnTheMembrane);  // inside
  EXPECT_EQ(geometry.SetEye({ 700.0, 0.0, 3.0 }, 1.0, 1.3), EyeStatus::Ready); // outside the facet
  EXPECT_EQ(geometry.SetEye({ 7.0, 1e-9, 3.0 }, 1.0, 1.3), EyeStatus::Ready);
  EXPECT_EQ(geometry.SetEye(eye, 1.0, 1.3), EyeStatus::Ready);
}

TEST(RefractionGeometry, EmptyMembraneHasNoImages)
{
  FlatMembraneSolver geometry;
  EXPECT_EQ(geometry.SetMembrane(meniscus::MembraneInput()), MembraneStatus::Empty);
  EXPECT_EQ(geometry.SetEye({ 0.0, 1.0, 0.0 }, 1.0, 1.3), EyeStatus::Ready);
  EXPECT_NE(geometry.SolvePoint({ 0.0, -1.0, 0.0 }).State, ImageState::Found);
}

//------------------------------------------------------------------------------
TEST(RefractionGeometry, ResultsDoNotDependOnTheRanges)
{
  const MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, 20, 8.0, 3.0);
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const FlatMembraneSolver serial = Make(mesh, eye, 1.0, 1.333);
  FlatMembraneSolver chopped;
  chopped.SetMembrane(mesh.AsInput());
  // Ranges of seven, in reverse order.
  const auto loop = [](std::size_t count, const meniscus::RangeBody& body)
  {
    for (std::size_t k = (count + 6) / 7; k-- > 0;)
    {
      body(7 * k, std::min(7 * k + 7, count));
    }
  };
  ASSERT_EQ(chopped.SetEye(eye, 1.0, 1.333, loop), EyeStatus::Ready);
  std::vector<double> points;
  Random random(61);
  for (int i = 0; i < 3000; ++i)
  {
    points.push_back(random(-100.0, 100.0));
  }
  std::vector<VirtualVertex> a(1000);
  std::vector<VirtualVertex> b(1000);
  serial.Solve(points.data(), 0, 1000, a.data());
  chopped.Solve(points.data(), 500, 1000, b.data());
  chopped.Solve(points.data(), 0, 500, b.data());
  for (std::size_t i = 0; i < 1000; ++i)
  {
    EXPECT_TRUE(Same(a[i], b[i])) << i;
  }
}

}
