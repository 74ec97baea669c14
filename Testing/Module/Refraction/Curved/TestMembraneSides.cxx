// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Side of a membrane on which a point lies, compared with analytic surfaces.
#include "MembraneMeshes.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Surface/PatchCrossings.h"
#include "RefractionTestRandom.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;
using meniscus::test::Random;

const double Pi = std::acos(-1.0);

constexpr int Points = 20000;

// z = r^2 / 2 up to a slope of `steepest` degrees, with the front above; `sign` -1 flips it.
MembraneMesh MakeParaboloid(int rings, double steepest, double sign)
{
  MembraneMesh mesh;
  const double rim = std::tan(steepest * Pi / 180.0);
  const int around = 4 * rings;
  mesh.AddPoint(glm::dvec3(0.0), { 0.0, 0.0, 1.0 });
  for (int ring = 1; ring <= rings; ++ring)
  {
    const double r = rim * ring / rings;
    for (int i = 0; i < around; ++i)
    {
      const double x = r * std::cos(2.0 * Pi * i / around);
      const double y = r * std::sin(2.0 * Pi * i / around);
      mesh.AddPoint(
        { x, y, sign * r * r / 2.0 }, glm::normalize(glm::dvec3(-sign * x, -sign * y, 1.0)));
    }
  }
  for (int i = 0; i < around; ++i)
  {
    mesh.AddTriangle(0, 1 + i, 1 + (i + 1) % around);
  }
  mesh.AddRings(1, rings, around);
  return mesh;
}

// A cylinder along z, 1 wide and 1 high in both directions: a side of `rings` rows, a cap below,
// and one above unless it is a cup. Normals are those of the sides; at the edges they are between
// two of them.
MembraneMesh MakeCylinder(int rings, int around, double side, bool isCup)
{
  MembraneMesh mesh;
  for (int ring = 0; ring < rings; ++ring)
  {
    const double z = -1.0 + 2.0 * ring / (rings - 1);
    const double lean = ring == 0 ? -1.0 : (ring == rings - 1 && !isCup ? 1.0 : 0.0);
    for (int i = 0; i < around; ++i)
    {
      const glm::dvec3 out(std::cos(2.0 * Pi * i / around), std::sin(2.0 * Pi * i / around), 0.0);
      mesh.AddPoint(out + glm::dvec3(0.0, 0.0, z), side * (out + glm::dvec3(0.0, 0.0, lean)));
    }
  }
  mesh.AddRings(0, rings, around);
  const std::int64_t middle = rings * around;
  mesh.AddPoint({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, -side });
  mesh.AddPoint({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, side });
  for (int i = 0; i < around; ++i)
  {
    const int next = (i + 1) % around;
    mesh.AddTriangle(middle, next, i);
    if (!isCup)
    {
      mesh.AddTriangle(middle + 1, (rings - 1) * around + i, (rings - 1) * around + next);
    }
  }
  return mesh;
}

MembraneMesh Transform(const MembraneMesh& mesh, const std::function<glm::dvec3(glm::dvec3)>& turn,
  const glm::dvec3& offset)
{
  MembraneMesh result;
  result.Triangles = mesh.Triangles;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const double* p = mesh.Points.data() + i;
    const double* n = mesh.Normals.data() + i;
    result.AddPoint(turn({ p[0], p[1], p[2] }) + offset, turn({ n[0], n[1], n[2] }));
  }
  return result;
}

// Rotation that makes everything oblique.
glm::dvec3 Turn(const glm::dvec3& v)
{
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  return v * std::cos(1.1) + glm::cross(axis, v) * std::sin(1.1) +
    axis * (glm::dot(axis, v) * (1.0 - std::cos(1.1)));
}

glm::dvec3 GetDirection(Random& random)
{
  glm::dvec3 v(0.0);
  do
  {
    v = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
  } while (glm::length(v) > 1.0 || glm::length(v) < 0.1);
  return glm::normalize(v);
}

void Set(CurvedMembraneSolver& geometry, const MembraneMesh& mesh)
{
  ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  geometry.PrepareSides();
}

bool IsInFront(const CurvedMembraneSolver& geometry, const glm::dvec3& point)
{
  return geometry.IsInFront(point - geometry.GetMembrane().GetOrigin());
}

// Number of points, drawn by `make`, that are in front although `front` is false, or the other way
// round.
int CountWrong(const CurvedMembraneSolver& geometry, bool front,
  const std::function<glm::dvec3(Random&)>& make, unsigned seed, int points = Points)
{
  Random random(seed);
  int wrong = 0;
  for (int i = 0; i < points; ++i)
  {
    wrong += IsInFront(geometry, make(random)) != front;
  }
  return wrong;
}

// Patches reproduce spheres up to rounding, so only rounding limits how close a point may be.
TEST(RefractionSide, OfClosedSpheres)
{
  for (const auto& [resolution, side] : Product(List(16, 64, 192), List(1.0, -1.0)))
  {
    CurvedMembraneSolver geometry;
    Set(geometry, MakeSphere(resolution, side));
    ASSERT_TRUE(geometry.IsClosed());
    const auto at = [](double least, double most)
    {
      return [least, most](Random& random)
      {
        const double distance = random(least, most);
        return GetDirection(random) * distance;
      };
    };
    EXPECT_EQ(CountWrong(geometry, side < 0.0, at(0.0, 0.95), 1), 0) << resolution << " " << side;
    EXPECT_EQ(CountWrong(geometry, side > 0.0, at(1.05, 3.0), 2, 5000), 0)
      << resolution << " " << side;
    EXPECT_EQ(CountWrong(geometry, side < 0.0, at(1.0 - 1e-9, 1.0 - 1e-9), 3, 2000), 0)
      << resolution;
    EXPECT_EQ(CountWrong(geometry, side > 0.0, at(1.0 + 1e-9, 1.0 + 1e-9), 4, 2000), 0)
      << resolution;
    EXPECT_EQ(geometry.GetNumberOfUndecidedSides(), 0);
  }
}

// Largest distance in height between patches and paraboloid, at the places tested.
double MeasureError(const CurvedMembraneSolver& geometry, double sign)
{
  double error = 0.0;
  for (std::size_t i = 0; i < geometry.GetMembrane().GetFacets().size(); ++i)
  {
    const CurvedPatch patch = geometry.GetPatches().GetPatch(static_cast<std::int32_t>(i));
    for (int k = 0; k <= 6; ++k)
    {
      for (int l = 0; l <= 6 - k; ++l)
      {
        const glm::dvec3 p =
          patch.Evaluate({ k / 6.0, l / 6.0 }).Position + geometry.GetMembrane().GetOrigin();
        error = std::max(error, std::fabs(p.z - sign * (p.x * p.x + p.y * p.y) / 2.0));
      }
    }
  }
  return error;
}

TEST(RefractionSide, OfSteepBowlsAndDomes)
{
  for (const double steepest : { 45.0, 70.0, 80.0 })
  {
    for (const int rings : { 12, 40, 120 })
    {
      for (const double sign : { 1.0, -1.0 })
      {
        CurvedMembraneSolver geometry;
        Set(geometry, MakeParaboloid(rings, steepest, sign));
        // Twice the sampled error; the rim's chords are within 1 - cos(pi / 48) of it.
        const double error = 2.0 * MeasureError(geometry, sign);
        const double rim = 0.99 * std::tan(steepest * Pi / 180.0);
        ASSERT_LT(error, 0.1 * rim);
        const auto at = [rim, sign, error](double up)
        {
          return [rim, sign, error, up](Random& random)
          {
            const double r = rim * std::sqrt(random(0.0, 1.0));
            const double azimuth = random(0.0, 2.0 * Pi);
            const double away = error + rim * random(0.0, 1.0);
            return glm::dvec3(
              r * std::cos(azimuth), r * std::sin(azimuth), sign * r * r / 2.0 + up * away);
          };
        };
        EXPECT_EQ(CountWrong(geometry, true, at(1.0), 5), 0) << steepest << " " << rings;
        EXPECT_EQ(CountWrong(geometry, false, at(-1.0), 6, 5000), 0) << steepest << " " << rings;
        EXPECT_EQ(geometry.GetNumberOfUndecidedSides(), 0);
      }
    }
  }
}

// Sides of a body that are parallel to many directions, with points close to them.
TEST(RefractionSide, OfCylinders)
{
  for (const bool isTurned : { false, true })
  {
    const auto turn = [isTurned](const glm::dvec3& v) { return isTurned ? Turn(v) : v; };
    for (const bool isCup : { false, true })
    {
      CurvedMembraneSolver geometry;
      // The front of the cup is on its inside.
      const double side = isCup ? -1.0 : 1.0;
      Set(geometry, Transform(MakeCylinder(20, 60, side, isCup), turn, { 1e3, 2e3, -3e3 }));
      ASSERT_EQ(geometry.IsClosed(), !isCup);
      // Patches of an arc of 6 degrees are within 1e-5 of it; rims are chords, 1.4e-3 inside.
      const auto at = [&turn](double least, double most, double height)
      {
        return [&turn, least, most, height](Random& random)
        {
          const double r = random(least, most);
          const double azimuth = random(0.0, 2.0 * Pi);
          const double z = random(-height, height);
          return turn({ r * std::cos(azimuth), r * std::sin(azimuth), z }) +
            glm::dvec3(1e3, 2e3, -3e3);
        };
      };
      EXPECT_EQ(CountWrong(geometry, isCup, at(0.0, 0.99, 0.99), 7, 4000), 0) << isCup << isTurned;
      EXPECT_EQ(CountWrong(geometry, isCup, at(0.99, 0.998, 0.85), 8, 4000), 0)
        << isCup << isTurned;
      EXPECT_EQ(CountWrong(geometry, !isCup, at(1.002, 1.01, 0.85), 9, 4000), 0)
        << isCup << isTurned;
      EXPECT_EQ(CountWrong(geometry, !isCup, at(1.01, 2.0, 0.85), 10, 4000), 0)
        << isCup << isTurned;
      EXPECT_EQ(geometry.GetNumberOfUndecidedSides(), 0);
    }
  }
}

// Points above and below vertices, edges and walls, so that the line along the axis runs through
// these.
TEST(RefractionSide, OfPointsInLineWithVerticesAndWalls)
{
  // Walls of the cup, with points above, below and inside of them.
  const MembraneMesh cup = MakeCylinder(9, 16, -1.0, true);
  CurvedMembraneSolver geometry;
  Set(geometry, cup);
  for (int i = 0; i < 16; ++i)
  {
    const double x = std::cos(2.0 * Pi * i / 16.0);
    const double y = std::sin(2.0 * Pi * i / 16.0);
    EXPECT_TRUE(IsInFront(geometry, { x, y, 1.5 }));
    EXPECT_FALSE(IsInFront(geometry, { x, y, -1.5 }));
    EXPECT_FALSE(IsInFront(geometry, { 0.5 * x, 0.5 * y, -1.5 }));
    for (const double z : { -1.0, -0.5, -0.3, 0.0, 0.75 })
    {
      EXPECT_TRUE(IsInFront(geometry, { x, y, z })) << "on the wall " << i << " " << z;
      EXPECT_TRUE(IsInFront(geometry, { (1.0 - 1e-9) * x, (1.0 - 1e-9) * y, z })) << i << " " << z;
    }
  }
  // A sphere whose poles and meridians are in line with its axis, whatever the axis is.
  CurvedMembraneSolver sphere;
  const glm::dvec3 axis(std::sqrt(1.0 / 6.0), std::sqrt(1.0 / 3.0), std::sqrt(0.5));
  const HeightFrame frame(axis);
  Set(sphere,
    Transform(
      MakeSphere(16, 1.0),
      [&frame](const glm::dvec3& v)
      { return v.x * frame.First + v.y * frame.Second + v.z * frame.Axis; },
      glm::dvec3(0.0)));
  const auto& positions = sphere.GetMembrane().GetPositions();
  for (const glm::dvec3& p : positions)
  {
    const glm::dvec3 across = p - axis * glm::dot(axis, p);
    const double half = std::sqrt(std::max(0.0, 1.0 - glm::dot(across, across)));
    for (const double height : { -2.0, -1.5, -0.9, -0.1, 0.0, 0.2, 0.9, 1.4 })
    {
      if (std::fabs(std::fabs(height) - half) > 1e-6)
      {
        EXPECT_EQ(IsInFront(sphere, across + height * axis), std::fabs(height) > half)
          << glm::length(across) << " " << height;
      }
    }
    EXPECT_TRUE(IsInFront(sphere, p + sphere.GetMembrane().GetOrigin())) << "on the sphere";
  }
  EXPECT_EQ(geometry.GetNumberOfUndecidedSides(), 0);
  EXPECT_EQ(sphere.GetNumberOfUndecidedSides(), 0);
}

// All crossings of a patch with lines in any direction, in closed form. Patches reproduce spheres.
TEST(RefractionSide, FindsAllCrossingsOfAPatch)
{
  Random random(11);
  const CurvedPatch sphere = []
  {
    CurvedMembraneSolver geometry;
    EXPECT_EQ(geometry.SetMembrane(MakeSphere(8, 1.0).AsInput()), MembraneStatus::Ready);
    return geometry.GetPatches().GetPatch(12);
  }();
  int crossed[3] = { 0, 0, 0 };
  for (int i = 0; i < Points; ++i)
  {
    const glm::dvec3 direction = GetDirection(random);
    const HeightFrame frame(direction);
    const glm::dvec2 b(random.Point(glm::dvec3(-0.2), glm::dvec3(1.0)));
    const glm::dvec3 through = sphere.Evaluate(b).Position;
    const glm::dvec2 place = frame.Project(through);
    const double squared = 1.0 - glm::dot(place, place);
    int expected = 0;
    bool isClose = squared < 1e-9;
    for (const double sign : { -1.0, 1.0 })
    {
      const glm::dvec3 at = place.x * frame.First + place.y * frame.Second +
        sign * std::sqrt(std::max(squared, 0.0)) * direction;
      // Seen from the centre: a multiple of a flat point.
      const glm::dvec3 u = sphere.Corner[1] - sphere.Corner[0];
      const glm::dvec3 v = sphere.Corner[2] - sphere.Corner[0];
      const glm::dvec3 n = glm::cross(u, v);
      // The normal at b is that of the flat point, up to its length.
      const glm::dvec3 flat = at * (glm::dot(n, sphere.Corner[0]) / glm::dot(n, at));
      const glm::dvec3 w = flat - sphere.Corner[0];
      const double x = glm::dot(glm::cross(w, v), n) / glm::dot(n, n);
      const double y = glm::dot(glm::cross(u, w), n) / glm::dot(n, n);
      const double least = std::min({ x, y, 1.0 - x - y });
      expected += least > 0.0 && glm::dot(n, at) * glm::dot(n, sphere.Corner[0]) > 0.0;
      isClose = isClose || std::fabs(least) < 1e-7;
    }
    if (isClose)
    {
      continue;
    }
    PatchCrossings crossings(sphere, frame);
    crossings.Find(place, -2.0, 2.0);
    EXPECT_TRUE(crossings.IsComplete());
    std::vector<double> heights;
    for (const PatchCrossing& crossing : crossings)
    {
      EXPECT_NEAR(glm::dot(place, place) + crossing.Height * crossing.Height, 1.0, 1e-12);
      EXPECT_EQ(crossing.Side, crossing.Height > 0.0 ? 1 : -1);
      if (std::none_of(heights.begin(), heights.end(),
            [&crossing](double h) { return std::fabs(h - crossing.Height) < 1e-9; }))
      {
        heights.push_back(crossing.Height);
      }
    }
    EXPECT_EQ(static_cast<int>(heights.size()), expected) << i;
    ++crossed[expected];
  }
  EXPECT_GT(crossed[0], 1000);
  EXPECT_GT(crossed[1], 1000);
  EXPECT_GT(crossed[2], 100);
}

// An eye on a patch is detected, whatever the patch's curvature; an eye next to it is not on it.
TEST(RefractionSide, OfAnEyeOnAPatch)
{
  Random random(12);
  const MembraneMesh meshes[] = { MakeSphere(8, 1.0), MakeParaboloid(4, 80.0, 1.0),
    meniscus::reference::MakeRandom(8.0, 8, 1.5, 1.2, 13), MakeCylinder(4, 6, 1.0, false) };
  for (const MembraneMesh& mesh : meshes)
  {
    CurvedMembraneSolver geometry;
    ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
    int found = 0;
    int falseAlarms = 0;
    constexpr int eyes = 500;
    for (int i = 0; i < eyes; ++i)
    {
      const double facets = static_cast<double>(geometry.GetMembrane().GetFacets().size());
      const auto facet = static_cast<std::int32_t>(random(0.0, facets));
      const CurvedPatch patch = geometry.GetPatches().GetPatch(facet);
      const double x = random(0.01, 0.98);
      const double y = random(0.01, 0.99 - x);
      const meniscus::PatchPoint at = patch.Evaluate({ x, y });
      const glm::dvec3 eye = at.Position + geometry.GetMembrane().GetOrigin();
      found += geometry.SetEye(eye, 1.0, 1.333) == meniscus::EyeStatus::OnTheMembrane;
      // A rough surface may come back to this place, but not for all of these.
      const glm::dvec3 beside = eye + 1e-5 * glm::normalize(at.Normal);
      falseAlarms += geometry.SetEye(beside, 1.0, 1.333) != meniscus::EyeStatus::Ready;
    }
    EXPECT_EQ(found, eyes);
    EXPECT_EQ(falseAlarms, 0);
  }
}

}
