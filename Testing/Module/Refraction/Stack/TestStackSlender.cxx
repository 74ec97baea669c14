// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lists whose first surface has facets that are much longer than wide, and than the scene.
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const glm::dvec3 Eye(0.3, 1.6, -0.4);

/** A plane about the y axis that is turned about z at the height `y`. */
MembraneMesh MakeTiltedPlane(double y, double angle)
{
  MembraneMesh plane = MakePlane(0.0, 40.0, 8);
  for (std::vector<double>* vectors : { &plane.Points, &plane.Normals })
  {
    for (std::size_t i = 0; i < vectors->size(); i += 3)
    {
      const glm::dvec2 v((*vectors)[i], (*vectors)[i + 1]);
      (*vectors)[i] = v.x * std::cos(angle) - v.y * std::sin(angle);
      (*vectors)[i + 1] = v.x * std::sin(angle) + v.y * std::cos(angle);
    }
  }
  plane.Translate({ 0.0, y, 0.0 });
  return plane;
}

/** The plane y = 0 in two facets. */
MembraneMesh MakeSea(double halfWidth, double slenderness)
{
  MembraneMesh sea = MakePlane(0.0, 2.0 * halfWidth, 1);
  sea.Translate(halfWidth * glm::dvec3(0.37, 0.0, -0.2));
  for (std::size_t i = 0; i < sea.Points.size(); i += 3)
  {
    sea.Points[i] /= slenderness;
  }
  return sea;
}

/** A list below the sea, and points that are seen through it. */
struct Scene
{
  const char* Name;
  MembraneMesh Second;
  glm::dvec3 Low;
  glm::dvec3 High;
};

}

//------------------------------------------------------------------------------
/** The images are those behind the same plane in facets of usual shape and size. */
TEST(RefractionStack, ImagesBehindSlenderFacetsAreFound)
{
  const Scene scenes[] = { { "tilted plane", MakeTiltedPlane(-0.8, 0.024), { -2.0, -3.2, -2.0 },
                             { 2.0, -1.2, 2.0 } },
    { "thin gap", MakeTiltedPlane(-0.01, 3e-4), { -2.0, -3.2, -2.0 }, { 2.0, -1.2, 2.0 } },
    { "ball", MakeSphere({ 0.2, -4.0, 0.1 }, 2.0, 3, true), { -0.8, -5.0, -0.9 },
      { 1.2, -3.0, 1.1 } } };
  for (const Scene& scene : scenes)
  {
    const auto second = MakeSurface(scene.Second);
    const auto set = [&second](StackSolver& solver, const MembraneMesh& sea) {
      SetStack(solver, { { MakeSurface(sea), { 1.0, 1.333 } }, { second, { 1.333, 1.5 } } }, Eye);
    };
    StackSolver reference;
    set(reference, MakePlane(0.0, 24.0, 24));
    for (const auto& [halfWidth, slenderness] :
      List(std::make_pair(1e5, 200.0), std::make_pair(1e7, 50.0), std::make_pair(1e7, 200.0)))
    {
      SCOPED_TRACE(::testing::Message()
        << scene.Name << ", half width " << halfWidth << ", slenderness " << slenderness);
      StackSolver solver;
      set(solver, MakeSea(halfWidth, slenderness));
      // Coordinates of the sea's rim have about 2e-16 of its width.
      const double rounding = 1e-11 + 1e-15 * halfWidth;
      Random random(41);
      for (int i = 0; i < 5; ++i)
      {
        const glm::dvec3 point = random.Point(scene.Low, scene.High);
        std::vector<StackPath> expected;
        std::vector<StackPath> images;
        EXPECT_EQ(reference.FindImages(point, expected), ImageState::Found);
        EXPECT_EQ(solver.FindImages(point, images), ImageState::Found);
        EXPECT_EQ(images.size(), expected.size());
        const StackVertex truth = SolveAlone(reference, point);
        const StackVertex found = SolveAlone(solver, point);
        ASSERT_EQ(found.State, ImageState::Found);
        EXPECT_LE(glm::length(found.Position - truth.Position), rounding);
      }
      EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
    }
  }
}
