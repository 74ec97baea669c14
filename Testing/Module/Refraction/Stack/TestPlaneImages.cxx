// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of many points behind parallel planes, against bisection and against points alone.
#include "Refraction/Stack/PlaneImages.h"
#include "Refraction/Stack/PlaneSights.h"
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

// A rotation without zeros, about the diagonal of the axes.
const glm::dmat3 Tilt = glm::dmat3(2.0, 2.0, -1.0, -1.0, 2.0, 2.0, 2.0, -1.0, 2.0) / 3.0;

struct Images
{
  std::vector<VirtualVertex> Vertices;
  std::vector<StackDetail> Details;
  std::vector<double> Legs;
};

Images SolveAll(const StackSolver& solver, const std::vector<double>& points, std::size_t range)
{
  const std::size_t count = points.size() / 3;
  const std::size_t legs = solver.GetStack().GetNumberOfInterfaces();
  Images images{ std::vector<VirtualVertex>(count), std::vector<StackDetail>(count),
    std::vector<double>(count * legs, -1.0) };
  for (std::size_t i = 0; i < count; i += range)
  {
    solver.Solve(points.data(), i, std::min(i + range, count), images.Vertices.data(),
      images.Details.data(), images.Legs.data());
  }
  return images;
}

// A square at right angles to the rotated y axis. Turned, it shows the eye its back.
MembraneMesh MakePlane(
  const glm::dmat3& rotation, double height, double size, int cells, bool isTurned)
{
  MembraneMesh mesh = MakeSquare(size, cells, 0.0);
  mesh.Translate({ 0.0, height, 0.0 });
  const auto rotate = [&rotation](double* p, double sign)
  {
    const glm::dvec3 rotated = sign * (rotation * glm::dvec3(p[0], p[1], p[2]));
    std::copy(&rotated.x, &rotated.x + 3, p);
  };
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    rotate(&mesh.Points[i], 1.0);
    rotate(&mesh.Normals[i], isTurned ? -1.0 : 1.0);
  }
  for (std::size_t i = 0; isTurned && i < mesh.Triangles.size(); i += 3)
  {
    std::swap(mesh.Triangles[i], mesh.Triangles[i + 1]);
  }
  return mesh;
}

// `number` planes below the eye, the second one turned, and one above the eye.
std::vector<Interface> MakePlanes(const glm::dmat3& rotation, int number)
{
  const std::vector<Interface> planes{ { MakeSurface(MakePlane(rotation, 120.0, 400.0, 3, false)),
                                         { 1.2, 1.0 } },
    { MakeSurface(MakePlane(rotation, 0.0, 400.0, 10, false)), { 1.0, 1.5 } },
    { MakeSurface(MakePlane(rotation, -20.0, 120.0, 7, true)), { 1.33, 1.5 } },
    { MakeSurface(MakePlane(rotation, -30.0, 400.0, 3, false)), { 1.33, 1.7 } } };
  return { planes.begin(), planes.begin() + number + 1 };
}

void ExpectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
  EXPECT_LE(glm::length(a - b), tolerance);
}

// Solves for the tangent in the first layer by bisection: lateral distances are monotone.
double BisectTangent(const std::vector<PlaneLayer>& layers, double depth, double distance)
{
  std::vector<double> thickness;
  std::vector<double> index;
  for (const PlaneLayer& layer : layers)
  {
    thickness.push_back(std::min(layer.End, depth) - layer.Begin);
    index.push_back(layer.Index);
  }
  const double sine = BisectSine(thickness, index, distance);
  return sine / std::sqrt((1.0 - sine) * (1.0 + sine));
}

}

//------------------------------------------------------------------------------
// Some points lie behind all planes, some between them, on them, in front of them or outside of
// their borders; one has NaN coordinates. Solved alone, a point converges to 1e-12 of a facet,
// which is 133 long; its cosine belongs to the place before the last step, which is at most 1e-5 of
// a facet long.
TEST(RefractionStackPlanes, ImagesOfManyPointsAreThoseOfPointsAlone)
{
  constexpr double tolerance = 1e-10 * 100.0;
  constexpr double lastStep = 1e-5 * 133.0 / 80.0;
  for (const bool isTilted : { false, true })
  {
    const glm::dmat3 rotation = isTilted ? Tilt : glm::dmat3(1.0);
    for (const int number : { 1, 2, 3 })
    {
      SCOPED_TRACE(::testing::Message() << number << " planes, tilted " << isTilted);
      StackSolver solver;
      SetStack(solver, MakePlanes(rotation, number), rotation * glm::dvec3(3.0, 80.0, -5.0));
      ASSERT_TRUE(solver.GetPlanes().AreExact());
      ASSERT_EQ(solver.GetStack().GetLinks().size(), static_cast<std::size_t>(number));
      Random random(41);
      std::vector<double> points;
      for (int i = 0; i < 700; ++i)
      {
        glm::dvec3 point = random.Point({ -90.0, -95.0, -90.0 }, { 90.0, 5.0, 90.0 });
        point.y = i % 50 == 7 ? -20.0 : point.y;
        point.x = i % 70 == 9 ? std::numeric_limits<double>::quiet_NaN() : point.x;
        point.z = i % 70 == 19 ? 1e5 * point.z : point.z;
        point = i % 70 == 29 ? glm::dvec3(3.0, -77.0, -5.0) : point; // straight below the eye
        point = rotation * point;
        points.insert(points.end(), { point.x, point.y, point.z });
      }
      const Images images = SolveAll(solver, points, points.size());
      const auto legs = static_cast<std::size_t>(number + 1);
      int behind = 0;
      for (std::size_t i = 0; i < images.Vertices.size(); ++i)
      {
        SCOPED_TRACE(i);
        const glm::dvec3 point(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
        StackSolver::Memory memory;
        const StackVertex alone = solver.SolvePoint(point, memory);
        const VirtualVertex& vertex = images.Vertices[i];
        const StackDetail& detail = images.Details[i];
        ASSERT_EQ(vertex.State, alone.State);
        if (i % 50 != 7) // a point on a plane is behind it or in front of it
        {
          ASSERT_EQ(detail.Passed, alone.Passed);
        }
        std::vector<double> lengths(legs);
        solver.MeasureLegs(point, alone.Passed > 0 ? memory.Path : StackPath{}, lengths.data());
        for (std::size_t k = 0; k < legs; ++k)
        {
          EXPECT_NEAR(images.Legs[legs * i + k], lengths[k], tolerance);
        }
        if (vertex.State != ImageState::Found)
        {
          continue;
        }
        behind += detail.Passed == number ? 1 : 0;
        ExpectNear(vertex.Position, alone.Position, tolerance);
        ExpectNear(vertex.SightPoint, alone.SightPoint, tolerance);
        if (detail.Passed == alone.Passed)
        {
          ExpectNear(detail.LastSightPoint, alone.LastSightPoint, tolerance);
          EXPECT_NEAR(detail.Transmittance, alone.Transmittance, lastStep);
        }
        EXPECT_NEAR(vertex.Depth, alone.Depth, tolerance);
        EXPECT_NEAR(vertex.Cosine, alone.Cosine, lastStep);
        EXPECT_NEAR(vertex.Reflectance, alone.Reflectance, lastStep);
        EXPECT_EQ(vertex.Facet, alone.Facet);
        EXPECT_EQ(vertex.Orientation, alone.Orientation);
      }
      EXPECT_GT(behind, 250);
    }
  }
}

//------------------------------------------------------------------------------
// Ranges of whole chains change no bit, nor do the points that are left out between others.
TEST(RefractionStackPlanes, RangesChangeNoBit)
{
  StackSolver solver;
  SetStack(solver, MakePlanes(Tilt, 2), Tilt * glm::dvec3(3.0, 80.0, -5.0));
  std::vector<double> points;
  for (int i = 0; i < 1000; ++i)
  {
    const glm::dvec3 point = Tilt * glm::dvec3(0.125 * (i % 97) - 6.0, i % 13 - 60.0, 0.25 * i);
    points.insert(points.end(), { point.x, point.y, point.z });
  }
  const Images whole = SolveAll(solver, points, points.size());
  const Images parts = SolveAll(solver, points, StackSolver::Chain);
  EXPECT_EQ(whole.Legs, parts.Legs);
  for (std::size_t i = 0; i < whole.Vertices.size(); ++i)
  {
    EXPECT_EQ(whole.Vertices[i].Position, parts.Vertices[i].Position);
    EXPECT_EQ(whole.Vertices[i].Facet, parts.Vertices[i].Facet);
    EXPECT_EQ(whole.Details[i].LastSightPoint, parts.Details[i].LastSightPoint);
  }
}

//------------------------------------------------------------------------------
// Coordinates of single precision are planes within their rounding, and not exact.
TEST(RefractionStackPlanes, RoundedPlanesAreNotExact)
{
  MembraneMesh mesh = MakePlane(glm::dmat3(1.0), 0.0, 100.0, 1, false);
  mesh.Points[1] += 1e-6;
  StackSolver solver;
  SetStack(solver, { { MakeSurface(mesh), { 1.0, 1.33 } } }, { 0.0, 50.0, 0.0 });
  EXPECT_FALSE(solver.GetPlanes().IsEmpty());
  EXPECT_FALSE(solver.GetPlanes().AreExact());
}

//------------------------------------------------------------------------------
// A place passes if the angle between its sight ray and the direction in which it is drawn is below
// the tolerance. Places that are drawn at the axis, grazing, or behind the eye fail.
TEST(RefractionStackPlanes, PlacesAreDrawnWithinTheTolerance)
{
  const glm::dvec3 eye = Tilt * glm::dvec3(3.0, 80.0, -5.0);
  StackSolver solver;
  SetStack(solver, MakePlanes(Tilt, 3), eye);
  const auto& planes = solver.GetPlanes();
  constexpr double angle = 1e-6;
  for (const double ratio : { 0.999, 1.001 })
  {
    std::vector<std::size_t> failed;
    PlaneSights sights(planes, ratio * angle, failed);
    std::vector<std::size_t> expected;
    Random random(43);
    for (std::size_t i = 0; i < 600; ++i)
    {
      const std::size_t count = 1 + i / 3 % 3; // chains of the same, as of one cell, and others
      const double heights[3] = { random(-19.0, -1.0), random(-29.0, -21.0), random(-90.0, -31.0) };
      const glm::dvec3 point = Tilt *
        (i == 7 ? glm::dvec3(3.0, heights[count - 1], -5.0)
                : glm::dvec3(random(-50.0, 50.0), heights[count - 1], random(-50.0, 50.0)));
      const glm::dvec3 sight = planes.FindSight(point - solver.GetStack().GetOrigin(), count);
      const glm::dvec3 beside = glm::normalize(glm::cross(sight, random.Point(eye, eye + 1.0)));
      const glm::dvec3 drawn[6] = { sight, 7.0 * sight,
        std::cos(angle) * sight + std::sin(angle) * beside, Tilt * glm::dvec3(0.0, 1.0, 0.0),
        Tilt * glm::dvec3(1.0, -1e-9, 0.0), -sight };
      const bool fails = i % 6 > 2 || (i % 6 == 2 && ratio < 1.0);
      // The opposite of a sight ray is on its line.
      if (fails && i % 6 != 5)
      {
        expected.push_back(i);
      }
      sights.Add(i, count, point - eye, drawn[i % 6]);
    }
    sights.Finish();
    EXPECT_EQ(failed, expected);
  }
}

//------------------------------------------------------------------------------
// From the axis to grazing rays, with every instruction set.
TEST(RefractionStackPlanes, TangentsAgreeWithBisectionInEverySet)
{
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<PlaneLayer>> lists{ { { 0.0, 80.0, 1.0, 1.0 },
                                                      { 80.0, infinite, 1.33, 1.33 * 1.33 } },
    { { 0.0, 1e-3, 1.5, 2.25 }, { 1e-3, 20.0, 1.0, 1.0 }, { 20.0, infinite, 2.4, 5.76 } },
    { { 0.0, 5.0, 1.0, 1.0 }, { 5.0, 7.0, 1.5, 2.25 }, { 7.0, infinite, 1.0, 1.0 } } };
  for (const std::vector<PlaneLayer>& layers : lists)
  {
    std::vector<PlaneLanes> results;
    for (const auto set : meniscus::GetInstructionSets())
    {
      PlaneLanes lanes{};
      lanes.Count = PlaneLanes::Most;
      for (int i = 0; i < lanes.Count; ++i)
      {
        lanes.Depth[i] = layers.back().Begin + 1e-3 * (1 + i % 16) * (1 + i % 16);
        lanes.Distance[i] = i < 8 ? 0.0 : std::pow(10.0, 0.06 * i - 4.0);
      }
      lanes.FindTangents(layers, set);
      for (std::size_t layer = 0; layer < layers.size(); ++layer)
      {
        lanes.Pass(layers, layer, set);
      }
      results.push_back(lanes);
      EXPECT_EQ(std::memcmp(&lanes, &results.front(), sizeof(lanes)), 0) << NameOf(set);
    }
    const PlaneLanes& lanes = results.front();
    for (int i = 0; i < lanes.Count; ++i)
    {
      SCOPED_TRACE(i);
      const double tangent = BisectTangent(layers, lanes.Depth[i], lanes.Distance[i]);
      const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
      // The bisection knows the sine within rounding.
      const double rounding = 4.0 * std::numeric_limits<double>::epsilon();
      EXPECT_NEAR(lanes.FirstCosine[i], cosine, (8.0 + tangent * tangent) * rounding * cosine);
      EXPECT_NEAR(lanes.Side[i], lanes.Distance[i], 1e-13 * lanes.Distance[i]);
    }
  }
}
