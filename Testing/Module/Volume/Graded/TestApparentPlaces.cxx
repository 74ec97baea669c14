// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions in which points are seen through a medium: parabolas, images of a rod, shadows.
#include "GradedScene.h"

#include "TestBasics.h"
#include "Volume/Graded/ApparentPlaces.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Images of points in the coordinates of the scene. */
std::vector<ApparentPlace> Find(GradedScene& scene, const glm::dvec3& eye, double spread,
  int resolution, std::vector<glm::dvec3> points)
{
  const double radius = scene.Mesh.GetRadius();
  const glm::dvec3 center = scene.Mesh.GetCenter();
  for (glm::dvec3& point : points)
  {
    point = (point - center) / radius;
  }
  const GradedRayWalk walk(scene.Medium);
  return ApparentPlaces(walk, (eye - center) / radius, spread, resolution).Find(points, SerialLoop);
}

/** Root of a function between two places of different signs. */
template <typename Function>
double Bisect(double low, double high, const Function& function)
{
  const bool rises = function(high) > 0.0;
  for (int step = 0; step < 80; ++step)
  {
    const double middle = 0.5 * (low + high);
    ((function(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}

// n^2 = a + b y: the ray in the direction that is found is a parabola through the point.
TEST(ApparentPlaces, ParabolasLeadToThePoints)
{
  constexpr double base = 1.6;
  constexpr double slope = 0.3;
  GradedScene scene(CenteredGrid(5, 1.0), [](const glm::dvec3& p) { return base + slope * p.y; });
  RandomNumbers random(1);
  const glm::dvec3 eye(0.05, 0.1, 0.93);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 60; ++i)
  {
    points.emplace_back(
      random.Uniform(-0.4, 0.4), random.Uniform(-0.5, 0.5), random.Uniform(-0.9, 0.3));
  }
  const std::vector<ApparentPlace> found = Find(scene, eye, 0.5, 24, points);
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(found[i].Images, 1) << i;
    EXPECT_EQ(found[i].Orientation, 1) << i;
    const glm::dvec3 momentum = std::sqrt(base + slope * eye.y) * found[i].Direction;
    const double time = (points[i].z - eye.z) / momentum.z;
    const glm::dvec3 end = eye + time * (momentum + 0.5 * time * glm::dvec3(0.0, 0.5 * slope, 0.0));
    // Positions of the mesh are rounded to 2^-31 of its radius: the field is off by as much.
    EXPECT_NEAR(glm::distance(end, points[i]), 0.0, 1.0e-8) << i;
    largest = std::max(largest, glm::distance(found[i].Direction, glm::normalize(points[i] - eye)));
  }
  EXPECT_GT(largest, 0.05);
}

// A rod with n^2 = n0^2 (1 - g^2 r^2): a ray from the axis at the angle t meets, at the distance d,
// the height sin(t) / g sin(g d / cos(t)). Before the rod's focus it has some values three times.
TEST(ApparentPlaces, ImagesOfARodAreCounted)
{
  constexpr double g = 0.65;
  constexpr double distance = 2.9 / g;
  const MeshArrays rod =
    Moved(CenteredGrid(9, 1.0), [](const glm::dvec3& p) { return p * glm::dvec3(1.0, 1.0, 2.4); });
  GradedScene scene(
    rod, [](const glm::dvec3& p) { return 2.25 * (1.0 - g * g * (p.x * p.x + p.y * p.y)); });
  const glm::dvec3 eye(0.0, 0.0, 0.5 * distance);
  const auto heightAt = [](double angle)
  { return std::sin(angle) / g * std::sin(g * distance / std::cos(angle)); };
  // The height is largest near 0.23 and 0 at acos(2.9 / pi).
  const double zero = std::acos(g * distance / M_PI);
  ASSERT_GT(heightAt(0.23), 0.05);
  const struct
  {
    double Height;
    int Images;
    double Angle;
  } cases[] = {
    { 0.03, 3, Bisect(0.0, 0.2, [&](double t) { return heightAt(t) - 0.03; }) },
    { 0.04, 3, Bisect(0.0, 0.2, [&](double t) { return heightAt(t) - 0.04; }) },
    // Above the largest height, on the other side of the axis alone.
    { 0.08, 1, -Bisect(zero, 0.54, [&](double t) { return heightAt(t) + 0.08; }) },
  };
  for (const auto& one : cases)
  {
    const glm::dvec3 up(std::cos(0.4), std::sin(0.4), 0.0);
    const glm::dvec3 point = one.Height * up + glm::dvec3(0.0, 0.0, -0.5 * distance);
    const ApparentPlace found = Find(scene, eye, 0.6, 48, { point })[0];
    EXPECT_EQ(found.Images, one.Images) << one.Height;
    EXPECT_EQ(found.Orientation, 1) << one.Height;
    const double angle = std::atan2(glm::dot(found.Direction, up), -found.Direction.z);
    EXPECT_EQ(angle > 0.0, one.Angle > 0.0);
    EXPECT_NEAR(angle, one.Angle, 1.0e-6) << one.Height;
    // Places are off by the rounding of the mesh's, 2^-31 of its radius.
    EXPECT_NEAR(heightAt(angle), one.Height, 1.0e-8) << one.Height;
    const glm::dvec3 across(-up.y, up.x, 0.0);
    EXPECT_NEAR(glm::dot(found.Direction, across), 0.0, 1.0e-8);
  }
}

// n^2 = 1 + b y bends light upwards. As a stone that is thrown, it reaches no place below the
// parabola y = -1 / b + b z^2 / 4.
TEST(ApparentPlaces, PointsInTheShadowHaveNoImage)
{
  constexpr double slope = 0.6;
  GradedScene scene(CenteredGrid(6, 1.5), [](const glm::dvec3& p) { return 1.0 + slope * p.y; });
  const glm::dvec3 eye(0.0, 0.0, 1.45);
  const glm::dvec3 shaded(0.1, -1.0, -1.45);
  const glm::dvec3 seen(0.1, 0.3, -1.45);
  ASSERT_LT(shaded.y, -1.0 / slope + 0.25 * slope * (2.9 * 2.9 + 0.01));
  const std::vector<ApparentPlace> found = Find(scene, eye, 0.8, 32, { shaded, seen });
  EXPECT_EQ(found[0].Images, 0);
  EXPECT_EQ(found[0].Orientation, 0);
  EXPECT_NEAR(glm::distance(found[0].Direction, glm::normalize(shaded - eye)), 0.0, 1.0e-12);
  EXPECT_EQ(found[1].Images, 1);
}

TEST(ApparentPlaces, OddPointsHaveNoImage)
{
  GradedScene scene(CenteredGrid(3, 1.0), [](const glm::dvec3&) { return 1.5; });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const glm::dvec3 eye(0.0, 0.0, 0.9);
  const std::vector<ApparentPlace> found =
    Find(scene, eye, 0.1, 4, { { nan, 0.0, 0.0 }, eye, { 0.1, 0.2, -5.0 }, { 0.1, 0.2, 5.0 } });
  EXPECT_EQ(found[0].Images, 0);
  EXPECT_EQ(found[1].Images, 0);
  EXPECT_EQ(found[2].Images, 1);
  // Behind the others' eye, by the straight direction alone.
  EXPECT_EQ(found[3].Images, 1);
  EXPECT_TRUE(Find(scene, eye, 0.1, 4, {}).empty());
}
