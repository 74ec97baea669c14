// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Virtual points behind parallel planes, one by one, against bisection and Snell's law.
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

//------------------------------------------------------------------------------
// Air, glass, water. Newton's method ends at 1e-12 of a facet of 40, the thickness is 100.
TEST(RefractionStack, PlaneLayersAgreeWithBisection)
{
  const glm::dvec3 eye(0.0, 80.0, 0.0);
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 400.0, 10)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(-20.0, 400.0, 7)), { 1.5, 1.333 } } },
    eye);
  EXPECT_TRUE(solver.GetStack().HasPassage());
  Random random(1);
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 point(random(-120.0, 120.0), random(-100.0, -21.0), random(-120.0, 120.0));
    const double r = std::hypot(point.x, point.z);
    const double sine = BisectSine({ 80.0, 20.0, -20.0 - point.y }, { 1.0, 1.5, 1.333 }, r);
    const double t1 = std::asin(sine);
    const double t2 = std::asin(sine / 1.5);
    const double t3 = std::asin(sine / 1.333);
    const double apparent = 20.0 / std::cos(t2) / 1.5 + (-20.0 - point.y) / std::cos(t3) / 1.333;
    const double length = 80.0 / std::cos(t1) + apparent;
    const glm::dvec3 truth = eye +
      length * glm::dvec3(std::sin(t1) * point.x / r, -std::cos(t1), std::sin(t1) * point.z / r);
    const StackVertex vertex = SolveAlone(solver, point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    EXPECT_EQ(vertex.Passed, 2);
    largest = std::max(largest, glm::length(vertex.Position - truth));
    EXPECT_NEAR(
      vertex.Depth, 20.0 / std::cos(t2) + (-20.0 - point.y) / std::cos(t3), 1e-10 * 100.0);
  }
  EXPECT_LT(largest, 1e-10 * 100.0);
  RecordProperty("largest_error", std::to_string(largest * 1e12) + "e-12");
}

//------------------------------------------------------------------------------
// The ray behind a pane is parallel to the sight ray, and shifted by d sin(t1 - t2) / cos(t2).
TEST(RefractionStack, PaneShiftsRaysAndKeepsTheirDirections)
{
  const glm::dvec3 eye(10.0, 60.0, -5.0);
  constexpr double thickness = 12.0;
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 300.0, 6)), { 1.0, 1.6 } },
      { MakeSurface(MakePlane(-thickness, 300.0, 6)), { 1.6, 1.0 } } },
    eye);
  Random random(2);
  for (int i = 0; i < 1000; ++i)
  {
    const glm::dvec3 point(random(-80.0, 80.0), random(-90.0, -13.0), random(-80.0, 80.0));
    const StackVertex vertex = SolveAlone(solver, point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    const glm::dvec3 sight = glm::normalize(vertex.SightPoint - eye);
    const glm::dvec3 last = glm::normalize(point - vertex.LastSightPoint);
    EXPECT_LT(glm::length(sight - last), 1e-11);
    const double t1 = std::acos(-sight.y);
    const double t2 = std::asin(std::sin(t1) / 1.6);
    EXPECT_NEAR(GetDistance(point, eye, sight), thickness * std::sin(t1 - t2) / std::cos(t2),
      1e-10 * thickness);
  }
}

//------------------------------------------------------------------------------
// Behind parallel planes a point has one image, which no search has to find: next to critical
// angles searches end undecided. Truth: n sin t is the same in all layers.
TEST(RefractionStack, PointsBehindPlanesNeedNoSearch)
{
  struct Trial
  {
    double Indices[3];
    double HalfWidth;
  };
  for (const Trial& trial : { Trial{ { 2.4, 1.6115, 2.4 }, 60.0 }, Trial{ { 2.1, 1.5, 2.1 }, 60.0 },
         Trial{ { 2.4, 1.6115, 2.4 }, 5e4 }, Trial{ { 1.5, 1.0, 1.333 }, 2e6 },
         Trial{ { 2.4, 1.5, 2.3956 }, 2e6 } })
  {
    SCOPED_TRACE(::testing::Message() << trial.Indices[0] << ", " << trial.Indices[1] << ", "
                                      << trial.Indices[2] << ", half width " << trial.HalfWidth);
    const double* n = trial.Indices;
    MembraneMesh first = MakePlane(0.0, 2.0 * trial.HalfWidth, 1);
    // A vertex of a facet without area does not count.
    first.AddPoint({ first.Points[0], 0.0, first.Points[2] }, glm::dvec3(0.0));
    first.AddTriangle(0, 4, 1);
    first.Translate(trial.HalfWidth * glm::dvec3(0.3, 0.0, -0.2));
    const glm::dvec3 eye(0.3, 2.1, -0.4);
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(first), { n[0], n[1] } },
        { MakeSurface(MakePlane(-0.1, 120.0, 2)), { n[1], n[2] } } },
      eye);
    ASSERT_EQ(solver.GetStack().GetLinks().size(), 2u);
    Random random(36);
    for (int i = 0; i < 100; ++i)
    {
      const glm::dvec3 point(random(-0.8, 0.8), random(-2.2, -0.15), random(-0.8, 0.8));
      std::vector<StackPath> images;
      solver.FindImages(point, images);
      ASSERT_EQ(images.size(), 1u);
      ASSERT_EQ(images[0].Count, 2u);
      const RayJet& last = images[0].GetLast();
      const glm::dvec3 away = point - solver.GetStack().GetOrigin() - last.Origin;
      // Coordinates have about 2e-16 of the half width; the tests' points are 0.05 away at least.
      const double rounding = 1e-11 + 1e-14 * trial.HalfWidth;
      EXPECT_LT(glm::length(glm::cross(away, last.Direction)), rounding);
      const auto sine = [](const glm::dvec3& way) { return std::hypot(way.x, way.z); };
      EXPECT_NEAR(n[0] * sine(images[0].Sight), n[2] * sine(last.Direction), rounding);
    }
    EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
  }
}

//------------------------------------------------------------------------------
// Rays run nearly along a gap of a millimetre: their directions there are lost in rounding, the
// places on the planes are not. The last plane of two lists is too small to show all points.
TEST(RefractionStack, PointsBehindThinGapsAreFound)
{
  struct Trial
  {
    double Indices[4];
    double HalfWidth;
    double Last;
    double Gap;
  };
  for (const Trial& trial : { Trial{ { 1.5, 1.0, 1.5, 1.33 }, 50.0, 60.0, 1e-3 },
         Trial{ { 2.27, 1.051, 2.258, 1.3 }, 50.0, 2.0, 1.6e-3 },
         Trial{ { 1.94, 1.313, 1.8, 1.505 }, 6.3e3, 60.0, 1.2e-3 },
         Trial{ { 2.09, 1.249, 2.094, 1.8 }, 5e6, 60.0, 3e-3 },
         Trial{ { 1.61, 1.28, 1.601, 1.62 }, 5e7, 4.0, 1e-3 } })
  {
    SCOPED_TRACE(::testing::Message() << "half width " << trial.HalfWidth);
    const double* n = trial.Indices;
    const double levels[5] = { 0.0, -trial.Gap, -0.5, 0.0, 0.0 };
    MembraneMesh first = MakePlane(0.0, 2.0 * trial.HalfWidth, 1);
    first.Translate(trial.HalfWidth * glm::dvec3(0.3, 0.0, -0.2));
    const glm::dvec3 eye(0.3, 0.1, -0.4);
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(first), { n[0], n[1] } },
        { MakeSurface(MakePlane(levels[1], 120.0, 2)), { n[1], n[2] } },
        { MakeSurface(MakePlane(levels[2], 2.0 * trial.Last, 2)), { n[2], n[3] } } },
      eye);
    ASSERT_EQ(solver.GetStack().GetLinks().size(), 3u);
    Random random(37);
    int seen = 0;
    for (int i = 0; i < 100; ++i)
    {
      const glm::dvec3 point(random(-9.0, 9.0), random(-2.2, -0.55), random(-9.0, 9.0));
      std::vector<StackPath> images;
      solver.FindImages(point, images);
      EXPECT_EQ(
        SolveAlone(solver, point).State, images.empty() ? ImageState::NoImage : ImageState::Found);
      seen += static_cast<int>(images.size());
      if (images.empty())
      {
        continue;
      }
      ASSERT_EQ(images.size(), 1u);
      ASSERT_EQ(images[0].Count, 3u);
      std::vector<glm::dvec3> places{ eye };
      for (int k = 0; k < 3; ++k)
      {
        places.push_back(images[0].Points[k].Ray.Origin + solver.GetStack().GetOrigin());
        EXPECT_NEAR(places.back().y, levels[k], 1e-12 + 1e-15 * trial.HalfWidth);
      }
      places.push_back(point);
      const auto sine = [&places](int k)
      {
        const glm::dvec3 way = places[k + 1] - places[k];
        return std::hypot(way.x, way.z) / glm::length(way);
      };
      // Coordinates have about 2e-16 of the half width, and legs are as short as the gap.
      const double rounding = 1e-11 + 1e-15 * trial.HalfWidth / trial.Gap;
      for (int k = 1; k < 4; ++k)
      {
        EXPECT_NEAR(n[0] * sine(0), n[k] * sine(k), rounding);
      }
      EXPECT_LE(std::max(std::fabs(places[3].x), std::fabs(places[3].z)), trial.Last + 1e-9);
    }
    EXPECT_EQ(seen == 100, trial.Last == 60.0);
    EXPECT_GT(seen, 0);
    EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
  }
}
