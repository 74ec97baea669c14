// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Intersections of rays with one surface, and rays that may be skipped.
#include "RefractionTestRandom.h"
#include "StackedRays.h"

#include "Refraction/Membrane/Membrane.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace meniscus;
using namespace meniscus::test;
using meniscus::testing::Random;

namespace
{

struct Counts
{
  int Shown = 0;
  int Hidden = 0;
  int Wrong = 0;
};

/** Compares the rays that reach the box, refracted or not, with rays of which none is skipped. */
void Compare(const RefractedRayStack& all, const RefractedRayStack& some,
  const RefractedRayStack::View& view, const WorldBox& box, Counts& counts)
{
  const glm::dmat3& toWorld = view.Frame.ViewToWorld;
  for (int row = 0; row < Size; ++row)
  {
    for (int column = 0; column < Size; ++column)
    {
      const double i = column + 0.5 - 0.5 * Size;
      const double j = row + 0.5 - 0.5 * Size;
      const RefractedRay exact = RayOf(all.GetRays()[0], column, row);
      const RefractedRay ray = RayOf(some.GetRays()[0], column, row);
      const bool same = exact.Depth == ray.Depth && exact.Step == ray.Step;
      const glm::dvec3 start = view.Center + toWorld * glm::dvec3(view.Frame.Origin.At(i, j), 0.0);
      const glm::dvec3 along = toWorld * glm::dvec3(view.Frame.Slope.At(i, j), 1.0);
      const glm::dvec3 eye = start + view.EyeDepth * along;
      const glm::dvec3 sightPoint = start + exact.Depth * along;
      const bool isStraight = box.Meets(eye, along, 1e30);
      const bool comes = exact.GoesOn() && box.Meets(sightPoint, toWorld * exact.Step, 1e30);
      const double length = exact.MeetsInterface() ? exact.Depth - view.EyeDepth : 1e30;
      counts.Shown += comes || box.Meets(eye, along, length) ? 1 : 0;
      counts.Hidden += exact.GoesOn() && !ray.GoesOn() ? 1 : 0;
      // Behind the membrane a ray may be skipped that does not reach the box there; in front of it,
      // a ray that does not reach the box straight on.
      const bool isRightBefore = exact.Depth == ray.Depth || !isStraight;
      counts.Wrong += same || (!comes && !ray.GoesOn() && isRightBefore) ? 0 : 1;
    }
  }
}

}

TEST(RefractedRayStack, LeavesOutOnlyRaysThatDoNotComeToTheMesh)
{
  Random random(11);
  Counts counts;
  for (const auto& shape : Shapes)
  {
    for (const int cells : { 1, 3, 12, 48 })
    {
      const Sheet sheet(shape, cells);
      for (int view = 0; view < 24; ++view)
      {
        const double side = view % 4 == 3 ? -1.0 : 1.0;
        const glm::dvec3 eye(random(-2.0, 2.0), random(-2.0, 2.0), side * random(0.2, 3.0));
        const glm::dvec3 target =
          random.Point(glm::dvec3(-0.8, -0.8, -0.1), glm::dvec3(0.8, 0.8, 0.1));
        RefractedRayStack::View looking =
          LookAt(eye, target, random(0.5, 3.0), view % 3 == 0, Size);
        const WorldBox box{ random.Point(glm::dvec3(-1.0, -1.0, -1.0), glm::dvec3(1.0, 1.0, 0.5)),
          random.Point(glm::dvec3(0.05), glm::dvec3(0.5)) };
        SetMesh(looking, Everywhere);
        const std::vector<Interface> water{ sheet.Between(1.0, 1.333) };
        RefractedRayStack all;
        all.Build(water, looking);
        SetMesh(looking, box);
        RefractedRayStack some;
        some.Build(water, looking);
        Compare(all, some, looking, box, counts);
        ASSERT_EQ(counts.Wrong, 0) << cells << " cells, view " << view;
      }
    }
  }
  EXPECT_GT(counts.Shown, 100000);
  EXPECT_GT(counts.Hidden, 100000);
}

/**
 * Every ray meets a coarse sphere at its exact intersection, including the outline, where a ray
 * meets one patch twice and Newton's method diverges.
 */
TEST(RefractedRayStack, MeetsSpheresAtTheirOutlines)
{
  Random random(31);
  int met = 0;
  int wrong = 0;
  int close = 0;
  for (const int resolution : { 10, 16, 24 })
  {
    const Sphere sphere(resolution);
    for (int i = 0; i < 12; ++i)
    {
      const double distance = i % 4 == 3 ? 0.7 : random(1.2, 5.0);
      const glm::dvec3 eye =
        distance * glm::normalize(random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)));
      const RefractedRayStack::View looking = LookAtAll(eye,
        0.1 * random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)), 2.5, i % 3 == 2 && distance > 1.0);
      RefractedRayStack sight;
      sight.Build({ sphere.Between(1.0, 1.333) }, looking);
      for (int pixel = 0; pixel < Size * Size; ++pixel)
      {
        const double x = pixel % Size + 0.5 - 0.5 * Size;
        const double y = pixel / Size + 0.5 - 0.5 * Size;
        const glm::dmat3& toWorld = looking.Frame.ViewToWorld;
        const glm::dvec3 start =
          looking.Center + toWorld * glm::dvec3(looking.Frame.Origin.At(x, y), 0.0);
        const glm::dvec3 along = toWorld * glm::dvec3(looking.Frame.Slope.At(x, y), 1.0);
        const double a = glm::dot(along, along);
        const double half = glm::dot(start, along) / a;
        const double squared = half * half - (glm::dot(start, start) - 1.0) / a;
        if (std::fabs(squared) < 1e-7)
        {
          ++close; // touches the sphere
          continue;
        }
        const double root = std::sqrt(std::max(squared, 0.0));
        const double first = -half - root > looking.EyeDepth ? -half - root : -half + root;
        const RefractedRay ray = RayOf(sight.GetRays()[0], pixel % Size, pixel / Size);
        const bool meets = squared > 0.0 && first > looking.EyeDepth;
        met += meets;
        // The error of Newton's method is 1e-8 of a facet, more where the ray touches the sphere.
        wrong += ray.MeetsInterface() != meets || (meets && std::fabs(ray.Depth - first) > 1e-6);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(met, 100000);
  EXPECT_LT(close, 100);
}

/**
 * A cylinder seen along its axis by parallel rays: those of one column of pixels pass its lowest
 * line, where the patch that begins there touches them along its whole length. No number of
 * crossings is right; each such pair of a ray and a patch is counted. Half a pixel aside there is
 * none.
 */
TEST(RefractedRayStack, CountsRaysThatRunAlongAPatch)
{
  const double cosine = std::cos(0.4);
  const double sine = std::sin(0.4);
  const double points[] = { 0.0, -1.0, -1.0, 0.0, -1.0, 1.0, sine, -cosine, -1.0, sine, -cosine,
    1.0 };
  const double normals[] = { 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, -sine, cosine, 0.0, -sine, cosine, 0.0 };
  const std::int64_t triangles[] = { 0, 2, 3, 0, 3, 1 };
  const TestSurface cylinder({ points, 4, triangles, 2, nullptr, normals });
  RefractedRayStack::View view;
  view.Width = Size;
  view.Height = Size;
  view.EyeDepth = -100.0;
  view.Frame.Origin.PerColumn = { 2.0 / Size, 0.0 };
  view.Frame.Origin.PerRow = { 0.0, 2.0 / Size };
  SetMesh(view, Everywhere);
  RefractedRayStack sight;
  for (const bool isAlong : { true, false })
  {
    // The pixel in the middle looks along the line from (0, -1, -1) to (0, -1, 1).
    const double half = isAlong ? 1.0 / Size : 0.0;
    view.Center = glm::dvec3(half, half - 1.0, 0.0);
    sight.Build({ cylinder.Between(1.0, 1.333) }, view);
    EXPECT_EQ(sight.GetCounts().Undecided > 0, isAlong);
  }
}
