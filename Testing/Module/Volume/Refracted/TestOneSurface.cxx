// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Intersections of rays with one surface.
#include "RefractionTestRandom.h"
#include "StackedRays.h"

using namespace meniscus;
using namespace meniscus::test;
using meniscus::test::Random;

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

/**
 * A dome of two facets above the eye, which is between them and their curved patches, and a plane
 * below. Rays continued backwards meet the dome from the same side as the plane: the plane is what
 * they meet.
 */
TEST(RefractedRayStack, MeetsNothingBehindTheEye)
{
  constexpr double radius = 6.0;
  const glm::dvec3 center(0.0, 0.0, -std::sqrt(radius * radius - 2.0)); // corners at the height 0
  std::vector<double> points;
  std::vector<double> normals;
  for (const bool isDome : { false, true })
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      const glm::dvec2 place(corner % 2 * 2.0 - 1.0, corner / 2 * 2.0 - 1.0);
      const glm::dvec3 up =
        glm::dvec3(place, std::sqrt(radius * radius - glm::dot(place, place))) / radius;
      const glm::dvec3 point = isDome ? center + radius * up : glm::dvec3(place, -1.0);
      const glm::dvec3 normal = isDome ? up : glm::dvec3(0.0, 0.0, 1.0);
      points.insert(points.end(), { point.x, point.y, point.z });
      normals.insert(normals.end(), { normal.x, normal.y, normal.z });
    }
  }
  const std::int64_t triangles[] = { 0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6 };
  const TestSurface plane({ points.data(), 4, triangles, 2, nullptr, normals.data() });
  const TestSurface both({ points.data(), 8, triangles, 4, nullptr, normals.data() });
  const RefractedRayStack::View view =
    LookAtAll(glm::dvec3(0.05, 0.02, 0.07), glm::dvec3(0.0, 0.0, -1.0), 1.0, false);
  RefractedRayStack expected;
  expected.Build({ plane.Between(1.0, 1.333) }, view);
  RefractedRayStack rays;
  rays.Build({ both.Between(1.0, 1.333) }, view);
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const RefractedRay ray = RayOf(rays.GetRays()[0], pixel % Size, pixel / Size);
    const RefractedRay known = RayOf(expected.GetRays()[0], pixel % Size, pixel / Size);
    ASSERT_TRUE(known.MeetsInterface());
    ASSERT_TRUE(ray.MeetsInterface());
    // The patch of the plane reproduces it within rounding.
    ASSERT_NEAR(ray.Depth, known.Depth, 1e-9);
  }
}
