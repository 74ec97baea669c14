// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays behind several interfaces, compared with Snell's law at planes and spheres.
#include "RefractionTestRandom.h"
#include "StackedRays.h"

#include "Simd/InstructionSets.h"
#include "Volume/Refracted/PatchIntersector.h"

#include <glm/gtc/constants.hpp>

using namespace meniscus;
using namespace meniscus::test;
using meniscus::test::Random;

namespace
{

/**
 * Snell's law for unit vectors, by components: along the surface the direction is multiplied by
 * n1 / n2. The result is 0 beyond the critical angle.
 */
glm::dvec3 Snell(const glm::dvec3& direction, glm::dvec3 normal, double before, double behind)
{
  normal = glm::dot(direction, normal) > 0.0 ? -normal : normal;
  const glm::dvec3 along = before / behind * (direction - glm::dot(direction, normal) * normal);
  const double squared = 1.0 - glm::dot(along, along);
  return squared < 0.0 ? glm::dvec3(0.0) : along - std::sqrt(squared) * normal;
}

/** Lengths at which a unit ray meets a sphere about the origin: the first and the second. */
bool MeetSphere(const WorldRay& ray, double radius, double& first, double& second)
{
  const double half = glm::dot(ray.Start, ray.Direction);
  const double squared = half * half - glm::dot(ray.Start, ray.Start) + radius * radius;
  first = -half - std::sqrt(std::max(squared, 0.0));
  second = -half + std::sqrt(std::max(squared, 0.0));
  return squared > 0.0;
}

}

/**
 * Rays through one interface find the patches by their projections, those of several by a tree;
 * both use the same Newton steps, whose error is below 1e-9 of a facet
 * (PatchIntersector::LastStep). Here the second interface is a sphere around everything, which has
 * the medium that most rays arrive in.
 */
TEST(RefractedRayStack, FirstLegsAreThoseOfOneInterface)
{
  const Sphere around(12, 50.0);
  Random random(3);
  int met = 0;
  int goingOn = 0;
  int different = 0;
  for (const auto& shape : Shapes)
  {
    for (const int cells : { 1, 3, 12, 48 })
    {
      const Sheet sheet(shape, cells);
      // The longest side of a facet is the diagonal of a square of side 2 / cells, on a slope of at
      // most 1: 4 / cells.
      const double twoErrors = 2.0 * 1e-9 * 4.0 / cells;
      for (int i = 0; i < 8; ++i)
      {
        const double side = i % 4 == 3 ? -1.0 : 1.0;
        const glm::dvec3 eye(random(-2.0, 2.0), random(-2.0, 2.0), side * random(0.2, 3.0));
        const RefractedRayStack::View view =
          LookAtAll(eye, random.Point(glm::dvec3(-0.8, -0.8, -0.1), glm::dvec3(0.8, 0.8, 0.1)),
            random(0.5, 3.0), i % 3 == 0);
        RefractedRayStack single;
        single.Build({ sheet.Between(1.0, 1.4) }, view);
        RefractedRayStack stack;
        stack.Build({ sheet.Between(1.0, 1.4), around.Between(1.2, side > 0.0 ? 1.4 : 1.0) }, view);
        EXPECT_EQ(stack.IsSeen(), single.IsSeen());
        for (int pixel = 0; pixel < Size * Size; ++pixel)
        {
          const RefractedRay one = RayOf(single.GetRays()[0], pixel % Size, pixel / Size);
          const RefractedRay other = RayOf(stack.GetRays()[0], pixel % Size, pixel / Size);
          met += one.MeetsInterface() ? 1 : 0;
          goingOn += other.GoesOn() ? 1 : 0;
          const bool same = one.MeetsInterface() == other.MeetsInterface() &&
            (!one.MeetsInterface() || std::fabs(one.Depth - other.Depth) < twoErrors) &&
            (!other.GoesOn() || glm::length(one.Step - other.Step) < 1e-8);
          different += same ? 0 : 1;
        }
      }
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(met, 100000);
  EXPECT_GT(goingOn, met / 2);
}

/** Rays keep their direction behind a pane, and are displaced by d sin(t1 - t2) / cos(t2). */
TEST(RefractedRayStack, PaneIsTheClosedForm)
{
  const double thickness = 0.4;
  const Sheet front([](double, double) { return 0.1; }, 5);
  const Sheet back([=](double, double) { return 0.1 - thickness; }, 7);
  int seen = 0;
  for (const bool parallel : { false, true })
  {
    RefractedRayStack::View view =
      LookAtAll(glm::dvec3(0.9, 0.6, 2.5), glm::dvec3(0.1, 0.0, 0.0), 1.2, parallel);
    RefractedRayStack stack;
    stack.Build({ front.Between(1.0, 1.5), back.Between(1.5, 1.0) }, view);
    const RayLegs legs = LegsOf(stack, view);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const WorldRay sight = LegOf(legs, view, pixel % Size, pixel / Size, 0);
      const WorldRay behind = LegOf(legs, view, pixel % Size, pixel / Size, 2);
      if (behind.Direction == glm::dvec3(0.0))
      {
        continue;
      }
      ++seen;
      EXPECT_LE(glm::length(behind.Direction - sight.Direction), 1e-14);
      const glm::dvec3 direction = glm::normalize(sight.Direction);
      const double outside = std::acos(-direction.z);
      const double inside = std::asin(std::sin(outside) / 1.5);
      const glm::dvec3 between = behind.Start - sight.Start;
      EXPECT_NEAR(glm::length(between - glm::dot(between, direction) * direction),
        thickness * std::sin(outside - inside) / std::cos(inside), 1e-13);
    }
    EXPECT_EQ(stack.GetCounts().Missing, 0);
    EXPECT_EQ(stack.GetCounts().Reflected, 0);
  }
  EXPECT_EQ(seen, 2 * Size * Size);
}

/** Each ray that meets a ball goes through it; its legs are those of a tracer in double. */
TEST(RefractedRayStack, BallIsEnteredAndLeft)
{
  Random random(17);
  int met = 0;
  int close = 0;
  int wrong = 0;
  double largest = 0.0;
  for (const int resolution : { 10, 16, 24 })
  {
    const Sphere sphere(resolution);
    for (const double index : { 1.5, 1.0 / 1.5 })
    {
      const glm::dvec3 eye =
        random(1.2, 5.0) * glm::normalize(random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)));
      RefractedRayStack::View view = LookAtAll(eye, glm::dvec3(0.0), 2.5, false);
      RefractedRayStack stack;
      stack.Build({ sphere.Between(1.0, index), sphere.Between(1.0, index) }, view);
      const RayLegs legs = LegsOf(stack, view);
      int reflected = 0;
      for (int pixel = 0; pixel < Size * Size; ++pixel)
      {
        WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, 0);
        ray.Direction = glm::normalize(ray.Direction);
        const WorldRay behind = LegOf(legs, view, pixel % Size, pixel / Size, 2);
        double first = 0.0;
        double second = 0.0;
        if (!MeetSphere(ray, 1.0, first, second))
        {
          wrong += behind.Direction != glm::dvec3(0.0) ? 1 : 0;
          continue;
        }
        ray.Start += first * ray.Direction;
        const double cosine = -glm::dot(ray.Direction, ray.Start);
        const double radicand = 1.0 - (1.0 - cosine * cosine) / (index * index);
        if (cosine < 1e-3 || std::fabs(radicand) < 1e-3)
        {
          ++close; // touches the ball, or is refracted along it
          continue;
        }
        const glm::dvec3 inside = Snell(ray.Direction, ray.Start, 1.0, index);
        if (inside == glm::dvec3(0.0))
        {
          ++reflected;
          wrong += behind.Direction != glm::dvec3(0.0) ? 1 : 0;
          continue;
        }
        ray.Direction = inside;
        MeetSphere(ray, 1.0, first, second);
        ray.Start += second * ray.Direction;
        ray.Direction = Snell(ray.Direction, ray.Start, index, 1.0);
        ++met;
        if (behind.Direction == glm::dvec3(0.0))
        {
          ++wrong;
          continue;
        }
        const double error = std::max(glm::length(behind.Start - ray.Start),
          glm::length(glm::normalize(behind.Direction) - ray.Direction));
        largest = std::max(largest, error);
      }
      EXPECT_EQ(reflected > 0, index < 1.0);
      // A ray inside a sphere leaves it at the angle at which it has entered.
      EXPECT_EQ(stack.GetCounts().Reflected, 0);
      EXPECT_EQ(stack.GetCounts().Missing, 0);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(met, 20000);
  EXPECT_LT(close, met / 100);
  // Newton's error, 1e-9 of a facet, grows by the inverse cosine at each surface, at most 1e3 where
  // no ray is left out.
  EXPECT_LT(largest, 1e-6);
}

/** From its centre, a shell between concentric spheres is not seen. */
TEST(RefractedRayStack, ConcentricDomeKeepsDirections)
{
  // The outer sphere is the unit sphere seen in another unit: its membrane is scaled.
  const Sphere inner(24);
  std::vector<double> points;
  std::vector<double> normals;
  std::vector<std::int64_t> triangles;
  for (const glm::dvec3& place : inner.Surface.GetPositions())
  {
    const glm::dvec3 normal = glm::normalize(place + inner.Surface.GetOrigin());
    normals.insert(normals.end(), { normal.x, normal.y, normal.z });
    points.insert(points.end(), { 1.2 * normal.x, 1.2 * normal.y, 1.2 * normal.z });
  }
  for (const Membrane::Facet& facet : inner.Surface.GetFacets())
  {
    triangles.insert(triangles.end(), facet.begin(), facet.end());
  }
  const TestSurface outer({ points.data(), points.size() / 3, triangles.data(),
    triangles.size() / 3, nullptr, normals.data() });
  RefractedRayStack::View view = LookAtAll(glm::dvec3(0.0), glm::dvec3(0.3, 0.4, -1.0), 1.8, false);
  // Air, glass, water; the normals point outwards.
  RefractedRayStack stack;
  stack.Build({ inner.Between(1.5, 1.0), outer.Between(1.333, 1.5) }, view);
  const RayLegs legs = LegsOf(stack, view);
  double largest = 0.0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const WorldRay sight = LegOf(legs, view, pixel % Size, pixel / Size, 0);
    const WorldRay behind = LegOf(legs, view, pixel % Size, pixel / Size, 2);
    ASSERT_NE(behind.Direction, glm::dvec3(0.0));
    largest = std::max(
      largest, glm::length(glm::normalize(behind.Direction) - glm::normalize(sight.Direction)));
    // Eq. 2.4: a unit of depth is 1.333 times as long in water.
    EXPECT_NEAR(glm::length(behind.Direction), 1.333 * glm::length(sight.Direction), 1e-12);
  }
  // The normals of a patch are those of its sphere within the error of Newton's last step.
  EXPECT_LT(largest, 1e-9);
}

/** Rays that pass the first sheet and miss the second end at the first, and are counted. */
TEST(RefractedRayStack, RaysThatMissAnInterfaceAreCounted)
{
  const Sheet front([](double, double) { return 0.1; }, 5);
  // A sheet that is seen through one half of the first one.
  const Sheet back([](double, double) { return -1.5; }, 4);
  RefractedRayStack::View view =
    LookAtAll(glm::dvec3(1.2, 0.0, 2.0), glm::dvec3(0.0, 0.0, 0.1), 2.3, false);
  RefractedRayStack stack;
  stack.Build({ front.Between(1.0, 1.5), back.Between(1.5, 1.0) }, view);
  const RayLegs legs = LegsOf(stack, view);
  int missing = 0;
  int through = 0;
  int beside = 0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, 0);
    const glm::dvec3 direction = glm::normalize(ray.Direction);
    const glm::dvec3 place = ray.Start + (0.1 - ray.Start.z) / ray.Direction.z * ray.Direction;
    const bool meetsFirst = std::max(std::fabs(place.x), std::fabs(place.y)) < 1.0;
    const glm::dvec3 inside = Snell(direction, glm::dvec3(0.0, 0.0, 1.0), 1.0, 1.5);
    const glm::dvec3 exit = place + (-1.5 - 0.1) / inside.z * inside;
    const double outside = std::max(std::fabs(exit.x), std::fabs(exit.y)) - 1.0;
    ASSERT_GT(std::fabs(outside), 1e-7); // no ray meets an edge
    const bool goesThrough = meetsFirst && outside < 0.0;
    beside += meetsFirst ? 0 : 1;
    missing += meetsFirst && outside > 0.0 ? 1 : 0;
    through += goesThrough ? 1 : 0;
    EXPECT_EQ(RayOf(stack.GetRays()[0], pixel % Size, pixel / Size).MeetsInterface(), meetsFirst);
    for (const int leg : { 1, 2 })
    {
      EXPECT_EQ(LegOf(legs, view, pixel % Size, pixel / Size, leg).Direction != glm::dvec3(0.0),
        goesThrough);
    }
  }
  EXPECT_EQ(stack.GetCounts().Missing, missing);
  EXPECT_GT(missing, 500);
  EXPECT_GT(through, 500);
  EXPECT_GT(beside, 500);
}

/** In a prism of 45 degrees all light is reflected, and each ray ends at the oblique face. */
TEST(RefractedRayStack, TotalReflectionEndsRays)
{
  const Sheet front([](double, double) { return 2.0; }, 2);
  const Sheet oblique([](double x, double) { return x; }, 3);
  RefractedRayStack::View view = LookAtAll(glm::dvec3(0.0, 0.0, 4.0), glm::dvec3(0.0), 1.8, true);
  RefractedRayStack stack;
  // The critical angle is 41.8 degrees for 1.5 and 48.8 degrees for 1.33.
  for (const double index : { 1.5, 1.33 })
  {
    stack.Build({ front.Between(1.0, index), oblique.Between(index, 1.0) }, view);
    EXPECT_EQ(stack.GetCounts().Reflected, index == 1.5 ? Size * Size : 0);
    EXPECT_EQ(stack.GetCounts().Missing, 0);
    const RayLegs legs = LegsOf(stack, view);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const WorldRay glass = LegOf(legs, view, pixel % Size, pixel / Size, 1);
      ASSERT_NE(glass.Direction, glm::dvec3(0.0));
      const RefractedRay last = RayOf(stack.GetRays()[1], pixel % Size, pixel / Size);
      EXPECT_EQ(last.GoesOn(), index == 1.33);
      const RefractedRay before = RayOf(stack.GetRays()[0], pixel % Size, pixel / Size);
      const glm::dvec3 end = glass.Start + (last.Depth - before.Depth) * glass.Direction;
      EXPECT_NEAR(end.z, end.x, 1e-13);
    }
  }
}

/** A surface is met only from the side of the medium that the ray is in. */
TEST(RefractedRayStack, RaysComeFromTheSideOfTheirMedium)
{
  const Sheet front([](double, double) { return 0.1; }, 2);
  const Sheet back([](double, double) { return -0.3; }, 3);
  RefractedRayStack::View view = LookAtAll(glm::dvec3(0.4, 0.2, 2.0), glm::dvec3(0.0), 0.8, false);
  const auto countMissing = [&](double exterior, double interior)
  {
    RefractedRayStack stack;
    stack.Build({ front.Between(1.0, 1.5), back.Between(exterior, interior) }, view);
    const bool hasMedium = exterior == 1.5 || interior == 1.5;
    EXPECT_EQ(stack.GetCounts().Mismatched, hasMedium ? 0 : Size * Size);
    return stack.GetCounts().Missing;
  };
  EXPECT_EQ(countMissing(1.5, 1.333), 0);
  EXPECT_EQ(countMissing(1.333, 1.5), Size * Size); // the glass would be below
  EXPECT_EQ(countMissing(1.0, 1.333), Size * Size); // no glass at all
  // An open surface listed twice is not met again.
  RefractedRayStack twice;
  twice.Build({ front.Between(1.0, 1.5), front.Between(1.0, 1.5) }, view);
  EXPECT_EQ(twice.GetCounts().Missing, Size * Size);
  // Nor is one in front of the first.
  RefractedRayStack reversed;
  reversed.Build({ back.Between(1.0, 1.5), front.Between(1.5, 1.0) }, view);
  EXPECT_EQ(reversed.GetCounts().Missing, Size * Size);
}
