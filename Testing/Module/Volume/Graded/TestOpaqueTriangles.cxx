// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Bent rays that end at triangles: closed forms, straight rays, closed surfaces, the way back.
#include "GradedScene.h"

#include "TestBasics.h"
#include "Volume/Graded/OpaqueTriangles.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

using Corners = std::vector<std::array<std::int32_t, 3>>;

/** Triangles in the units of a scene's walk. */
OpaqueTriangles MakeTriangles(
  const GradedScene& scene, std::vector<glm::dvec3> points, const Corners& corners)
{
  for (glm::dvec3& point : points)
  {
    point = (point - scene.Mesh.GetCenter()) / scene.Mesh.GetRadius();
  }
  OpaqueTriangles triangles;
  triangles.Build(std::move(points), corners);
  return triangles;
}

/** A square about a place, across a direction. */
OpaqueTriangles MakeSquare(
  const GradedScene& scene, const glm::dvec3& middle, const glm::dvec3& direction, double half)
{
  glm::dvec3 right;
  glm::dvec3 up;
  CrossAxes(glm::normalize(direction), right, up);
  return MakeTriangles(scene,
    { middle - half * (right + up), middle + half * (right - up), middle + half * (right + up),
      middle - half * (right - up) },
    { { 0, 1, 2 }, { 0, 2, 3 } });
}

/** Sight of a ray; places in the coordinates of the scene. */
OpaqueSight See(GradedScene& scene, const OpaqueTriangles& triangles, const glm::dvec3& origin,
  const glm::dvec3& direction, bool mayBeInMesh = true)
{
  const double radius = scene.Mesh.GetRadius();
  const glm::dvec3 center = scene.Mesh.GetCenter();
  scene.PrepareLanes();
  OpaqueSight sight;
  const std::vector<std::uint8_t> cells = triangles.FindCells(scene.Mesh);
  SeeTriangles(GradedRayWalk(scene.Medium), triangles, mayBeInMesh ? &cells : nullptr,
    { { (origin - center) / radius, direction } }, scene.Statistics, &sight);
  sight.Hit.Place = center + radius * sight.Hit.Place;
  return sight;
}

double BendingField(const glm::dvec3& p)
{
  return 2.0 + std::sin(2.0 * p.x + p.y) * std::cos(1.5 * p.z) + 0.5 * p.y * p.z;
}

/** An octahedron divided into smaller triangles, on a sphere. */
OpaqueTriangles MakeSphere(
  const GradedScene& scene, const glm::dvec3& middle, double radius, int divisions)
{
  std::vector<glm::dvec3> points;
  Corners corners;
  for (int octant = 0; octant < 8; ++octant)
  {
    const glm::dvec3 sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const bool isMirrored = sign.x * sign.y * sign.z < 0.0;
    const std::size_t firstOfOctant = corners.size();
    const auto place = [&](int i, int j)
    {
      const glm::dvec3 p(i, j, divisions - i - j);
      points.push_back(middle + radius * sign * glm::normalize(p));
      return static_cast<std::int32_t>(points.size() - 1);
    };
    for (int i = 0; i < divisions; ++i)
    {
      for (int j = 0; i + j < divisions; ++j)
      {
        // Each has points of its own: equal places count as the same.
        const std::int32_t first = place(i, j);
        corners.push_back({ first, place(i + 1, j), place(i, j + 1) });
        if (i + j + 2 <= divisions)
        {
          const std::int32_t second = place(i + 1, j);
          corners.push_back({ second, place(i + 1, j + 1), place(i, j + 1) });
        }
      }
    }
    for (std::size_t k = firstOfOctant; k < corners.size() && isMirrored; ++k)
    {
      std::swap(corners[k][1], corners[k][2]);
    }
  }
  return MakeTriangles(scene, points, corners);
}

}

// n^2 = a + b x: x is a parabola in the way along z.
TEST(OpaqueTriangles, ParabolaMeetsAPlane)
{
  constexpr double base = 1.6;
  constexpr double slope = 0.7;
  GradedScene scene(CenteredGrid(5, 1.0), [](const glm::dvec3& p) { return base + slope * p.x; });
  RandomNumbers random(1);
  for (const double depth : { 0.93, 0.4, 0.0, -0.61803, -1.5 })
  {
    const OpaqueTriangles plane = MakeSquare(scene, { 0.0, 0.0, depth }, { 0, 0, 1 }, 30.0);
    for (int i = 0; i < 50; ++i)
    {
      const glm::dvec3 eye(random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 1.0);
      const glm::dvec3 direction =
        glm::normalize(glm::dvec3(random.Uniform(-0.2, 0.1), random.Uniform(-0.2, 0.2), -1.0));
      const OpaqueSight sight = See(scene, plane, eye, direction, depth > -1.0);
      ASSERT_GE(sight.Hit.Triangle, 0);
      const glm::dvec3 momentum = std::sqrt(base + slope * eye.x) * direction;
      const glm::dvec3 force(0.5 * slope, 0.0, 0.0);
      const double inside = (1.0 - std::max(depth, -1.0)) / -momentum.z;
      const glm::dvec3 end = momentum + inside * force;
      const glm::dvec3 place = eye + inside * (momentum + 0.5 * inside * force) +
        std::max(-1.0 - depth, 0.0) / -end.z * end;
      // Positions of the mesh are rounded to 2^-31 of its radius: the field is off by as much.
      EXPECT_NEAR(glm::distance(sight.Hit.Place, place), 0.0, 1.0e-8) << depth;
      EXPECT_NEAR(glm::distance(sight.Direction, glm::normalize(end)), 0.0, 1.0e-8) << depth;
      EXPECT_EQ(
        sight.Hit.IsFront, sight.Hit.Triangle >= 0 && glm::dot(end, glm::dvec3(0, 0, 1)) < 0);
    }
  }
}

// Without bending, the first of many triangles on the straight line.
TEST(OpaqueTriangles, NothingBendsIsTheStraightPicture)
{
  GradedScene scene(CenteredGrid(4, 1.0), [](const glm::dvec3&) { return 1.7; });
  RandomNumbers random(2);
  std::vector<glm::dvec3> points;
  Corners corners;
  for (std::int32_t i = 0; i < 300; ++i)
  {
    const glm::dvec3 middle =
      2.0 * glm::dvec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    for (int k = 0; k < 3; ++k)
    {
      points.push_back(middle + 0.2 * random.GetDirection());
    }
    corners.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  const OpaqueTriangles triangles = MakeTriangles(scene, points, corners);
  int hits = 0;
  for (int ray = 0; ray < 3000; ++ray)
  {
    const glm::dvec3 eye = (ray % 2 ? 0.7 : 2.7) * random.GetDirection();
    const glm::dvec3 direction = random.GetDirection();
    double nearest = std::numeric_limits<double>::infinity();
    std::int32_t first = -1;
    for (std::int32_t i = 0; i < 300; ++i)
    {
      // Cramer's rule for eye + t direction = a + u (b - a) + v (c - a).
      const glm::dvec3 ab = points[3 * i + 1] - points[3 * i];
      const glm::dvec3 ac = points[3 * i + 2] - points[3 * i];
      const glm::dvec3 normal = glm::cross(ab, ac);
      const double whole = -glm::dot(direction, normal);
      const glm::dvec3 from = eye - points[3 * i];
      const glm::dvec3 turned = glm::cross(from, direction);
      const double u = glm::dot(ac, turned) / whole;
      const double v = -glm::dot(ab, turned) / whole;
      const double t = glm::dot(from, normal) / whole;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t < nearest)
      {
        nearest = t;
        first = i;
      }
    }
    const OpaqueSight sight = See(scene, triangles, eye, direction);
    ASSERT_EQ(sight.Hit.Triangle, first) << ray;
    hits += first >= 0 ? 1 : 0;
    if (first >= 0)
    {
      // Some hundred roundings of 2^-53 of places of the size 3.
      EXPECT_NEAR(glm::distance(sight.Hit.Place, eye + nearest * direction), 0.0, 1.0e-13);
    }
  }
  EXPECT_GT(hits, 200);
}

// A closed surface in a medium that bends strongly: no ray leaves it between its triangles.
TEST(OpaqueTriangles, NoRayLeavesAClosedSurface)
{
  GradedScene scene(CenteredGrid(7, 1.0), BendingField);
  const glm::dvec3 middle(0.1, -0.05, 0.07);
  const OpaqueTriangles sphere = MakeSphere(scene, middle, 0.7, 12);
  RandomNumbers random(3);
  for (int ray = 0; ray < 3000; ++ray)
  {
    const glm::dvec3 eye = middle + 0.6 * random.Uniform() * random.GetDirection();
    const OpaqueSight sight = See(scene, sphere, eye, random.GetDirection());
    ASSERT_GE(sight.Hit.Triangle, 0) << ray;
    EXPECT_FALSE(sight.Hit.IsFront);
    const double radius = glm::distance(sight.Hit.Place, middle);
    EXPECT_LT(radius, 0.7 + 1.0e-12);
    EXPECT_GT(radius, 0.68);
  }
  EXPECT_EQ(scene.Statistics.Lost + scene.Statistics.Trapped, 0);
}

// Light goes back to the eye on the way that the ray has come.
TEST(OpaqueTriangles, TheWayBackLeadsToTheEye)
{
  GradedScene scene(CenteredGrid(6, 1.0), BendingField);
  const OpaqueTriangles sphere = MakeSphere(scene, glm::dvec3(0.0), 0.9, 9);
  RandomNumbers random(4);
  for (int ray = 0; ray < 200; ++ray)
  {
    const glm::dvec3 eye = 0.5 * random.Uniform() * random.GetDirection();
    const glm::dvec3 direction = random.GetDirection();
    const OpaqueSight there = See(scene, sphere, eye, direction);
    ASSERT_GE(there.Hit.Triangle, 0);
    const OpaqueTriangles square = MakeSquare(scene, eye, direction, 0.05);
    const OpaqueSight back = See(scene, square, there.Hit.Place, -there.Direction);
    ASSERT_GE(back.Hit.Triangle, 0) << ray;
    // The goal for the way back is 1e-9 of the scene.
    EXPECT_NEAR(glm::distance(back.Hit.Place, eye), 0.0, 1.0e-9);
    EXPECT_NEAR(glm::distance(back.Direction, -direction), 0.0, 1.0e-9);
  }
}

// Objects behind the mesh are met by rays in lanes as by rays that are watched.
TEST(OpaqueTriangles, LanesSeeTheSame)
{
  GradedScene scene(CenteredGrid(6, 1.0), BendingField);
  const OpaqueTriangles before = MakeSquare(scene, { -0.5, 0.0, 1.8 }, { 0, 0, 1 }, 0.4);
  const OpaqueTriangles behind = MakeSphere(scene, { 0.4, 0.2, -2.5 }, 1.2, 6);
  RandomNumbers random(5);
  int hits = 0;
  for (int ray = 0; ray < 500; ++ray)
  {
    const OpaqueTriangles& object = ray % 2 ? before : behind;
    const glm::dvec3 eye(0.3, 0.1, 3.0);
    const glm::dvec3 direction(random.Uniform(-0.4, 0.4), random.Uniform(-0.4, 0.4), -1.0);
    const OpaqueSight alone = See(scene, object, eye, direction);
    const OpaqueSight lane = See(scene, object, eye, direction, false);
    EXPECT_EQ(alone.Hit.Triangle, lane.Hit.Triangle) << ray;
    hits += lane.Hit.Triangle >= 0 ? 1 : 0;
    EXPECT_NEAR(glm::distance(alone.Hit.Place, lane.Hit.Place), 0.0, 1.0e-11);
    EXPECT_NEAR(glm::distance(alone.Direction, lane.Direction), 0.0, 1.0e-11);
  }
  EXPECT_GT(hits, 100);
}

// Rays that never leave a cube of glass are stopped. They meet only triangles inside the cube.
TEST(OpaqueTriangles, TrappedRaysAreTold)
{
  GradedScene scene(
    CenteredGrid(2, 1.0), [](const glm::dvec3&) { return 9.0; }, 1.0);
  const glm::dvec3 eye(0.1, 0.15, 0.3);
  const glm::dvec3 direction(1.0, 1.1, -1.2);
  const OpaqueTriangles outside = MakeSphere(scene, glm::dvec3(0.0), 5.0, 3);
  for (const bool mayBeInMesh : { true, false })
  {
    const OpaqueSight sight = See(scene, outside, eye, direction, mayBeInMesh);
    EXPECT_EQ(sight.Hit.Triangle, -1);
    EXPECT_TRUE(sight.IsStopped);
  }
  const OpaqueSight inside = See(scene, MakeSphere(scene, glm::dvec3(0.0), 0.9, 3), eye, direction);
  EXPECT_GE(inside.Hit.Triangle, 0);
  EXPECT_FALSE(inside.IsStopped);
}

TEST(OpaqueTriangles, NothingIsNoObject)
{
  GradedScene scene(CenteredGrid(3, 1.0), BendingField);
  const OpaqueTriangles none = MakeTriangles(scene, {}, {});
  EXPECT_TRUE(none.IsEmpty());
  const glm::dvec3 direction(0.1, 0.05, -1.0);
  const OpaqueSight sight = See(scene, none, { 0, 0, 2 }, direction);
  EXPECT_EQ(sight.Hit.Triangle, -1);
  EXPECT_FALSE(sight.IsStopped);
  // A triangle without area.
  const OpaqueTriangles line =
    MakeTriangles(scene, { { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } }, { { 0, 1, 2 }, { 1, 1, 1 } });
  EXPECT_EQ(See(scene, line, { 0, 0, 2 }, { 0, 0, -1 }).Hit.Triangle, -1);
}

// Cells a thousand times as long as high are those that a plane cuts, none of their neighbours.
TEST(OpaqueTriangles, LongCellsAreMarkedIfTheyMayHoldATriangle)
{
  const MeshArrays arrays =
    Moved(KuhnGrid(9), [](const glm::dvec3& p) { return p * glm::dvec3(1000.0, 1.0, 1.0); });
  const GradedScene scene(arrays, [](const glm::dvec3&) { return 2.0; });
  const auto at = [&scene](double x, double y, double z)
  { return glm::dvec3(x, y, z) * scene.Mesh.GetRadius() + scene.Mesh.GetCenter(); };
  // A triangle far larger than the mesh, and one far smaller than a cell.
  const OpaqueTriangles plane = MakeTriangles(
    scene, { { -9e4, -500.0, 0.37 }, { 9e4, -500.0, 0.38 }, { 0.0, 9e4, 0.39 } }, { { 0, 1, 2 } });
  const glm::dvec3 small = at(0.3, 1e-4, 1e-4);
  const OpaqueTriangles speck = MakeTriangles(scene,
    { small, small + glm::dvec3(1e-6, 0, 0), small + glm::dvec3(0, 1e-6, 0) }, { { 0, 1, 2 } });
  const std::vector<std::uint8_t> cut = plane.FindCells(scene.Mesh);
  const glm::dvec3 normal = glm::cross(glm::dvec3(18e4, 0, 0.01), glm::dvec3(9e4, 90500.0, 0.02));
  for (std::size_t c = 0; c < cut.size(); ++c)
  {
    double least = 1.0;
    double most = -1.0;
    for (const auto vertex : scene.Mesh.GetCells()[c].Vertices)
    {
      const glm::dvec3 p = scene.Mesh.GetPosition(vertex) * scene.Mesh.GetRadius() +
        scene.Mesh.GetCenter() - glm::dvec3(-9e4, -500.0, 0.37);
      const double height = glm::dot(p, normal) / glm::length(normal);
      least = std::min(least, height);
      most = std::max(most, height);
    }
    EXPECT_EQ(cut[c] != 0, least < 0.0 && most > 0.0) << c;
  }
  const std::vector<std::uint8_t> marked = speck.FindCells(scene.Mesh);
  const auto count = std::count(marked.begin(), marked.end(), 1);
  EXPECT_GE(count, 1);
  EXPECT_LE(count, 2);
}

// In a gas, rays go in lanes but for cells that an object may be in, and see what each sees alone.
TEST(OpaqueTriangles, LanesSeeObjectsInTheMesh)
{
  GradedScene scene(CenteredGrid(8, 1.0),
    [](const glm::dvec3& p)
    { return 1.0005 + 2.0e-4 * std::sin(3.0 * p.x) * std::cos(2.0 * p.y + p.z); });
  scene.PrepareLanes();
  const OpaqueTriangles sphere = MakeSphere(scene, glm::dvec3(0.3, 0.1, -0.2), 0.25, 2);
  const std::vector<std::uint8_t> cells = sphere.FindCells(scene.Mesh);
  const auto marked = std::count(cells.begin(), cells.end(), 1);
  EXPECT_GT(marked, 0);
  EXPECT_LT(marked, static_cast<std::ptrdiff_t>(cells.size() / 8));
  const double radius = scene.Mesh.GetRadius();
  std::vector<GradedRay> rays;
  for (int i = 0; i < 900; ++i)
  {
    const glm::dvec3 place((i % 30 - 14.5) / 16.0, (i / 30 - 14.5) / 16.0, 3.0);
    rays.push_back({ place / radius, glm::dvec3(0.05, -0.03, -1.0) });
  }
  const GradedRayWalk walk(scene.Medium);
  std::vector<OpaqueSight> sights(rays.size());
  GradedRayStatistics statistics;
  SeeTriangles(walk, sphere, &cells, rays, statistics, sights.data());
  EXPECT_GT(statistics.LaneSteps, statistics.Steps / 2);
  int seen = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    OpaqueVisitor visitor(sphere);
    walk.Follow(rays[i], scene.Statistics, visitor);
    ASSERT_EQ(sights[i].Hit.Triangle, visitor.Hit.Triangle) << i;
    if (visitor.Hit.Triangle >= 0)
    {
      ++seen;
      EXPECT_NEAR(glm::distance(sights[i].Hit.Place, visitor.Hit.Place), 0.0, 1.0e-12);
      EXPECT_NEAR(glm::distance(sights[i].Hit.Direction, visitor.Hit.Direction), 0.0, 1.0e-12);
    }
  }
  EXPECT_GT(seen, 20);
}
