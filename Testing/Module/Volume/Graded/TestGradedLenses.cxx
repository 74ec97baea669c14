// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lenses with closed forms. n^2 is off by the third power of the cells' size h and its gradient by
// the square, so that rays are of order 2. Quadratic fields are exact in the cells.
#include "GradedScene.h"
#include "TestBasics.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Numbers of cubes per edge: 6 * 9^3 = 4,374 cells, 34,992 and 279,936. */
const int Sizes[3] = { 9, 18, 36 };

/** Mean order of the errors on the three meshes. */
double OrderOf(const double (&errors)[3])
{
  return 0.5 * std::log2(errors[0] / errors[2]);
}

/** Root of the mean square. */
class MeanError
{
public:
  void Add(double error)
  {
    this->Sum += error * error;
    ++this->Count;
  }
  double Get() const { return std::sqrt(this->Sum / this->Count); }

private:
  double Sum = 0.0;
  int Count = 0;
};

/** Grid of offsets in the disc of a radius. */
template <typename Body>
void ForEachOffset(double radius, Body&& body)
{
  for (int j = -5; j <= 5; ++j)
  {
    for (int i = -5; i <= 5; ++i)
    {
      const double x = radius * (i + 0.137) / 5.2;
      const double y = radius * (j + 0.291) / 5.4;
      if (x * x + y * y < radius * radius)
      {
        body(x, y);
      }
    }
  }
}

const glm::dvec3 Along = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));

/** RMS distance from the focus of parallel rays in Luneburg's lens, n^2 = 2 - r^2. */
double LuneburgError(int n)
{
  GradedScene scene(BallOfCubes(n, 1.0), [](const glm::dvec3& p) { return 2.0 - glm::dot(p, p); });
  glm::dvec3 right;
  glm::dvec3 up;
  CrossAxes(Along, right, up);
  MeanError mean;
  ForEachOffset(0.9,
    [&](double x, double y)
    {
      const GradedRayResult ray = scene.Trace(x * right + y * up - 2.0 * Along, Along);
      // The way from the last place in the polyhedron to the plane of the focus is straight.
      const double rest = glm::dot(Along - ray.Exit, Along) / glm::dot(ray.Direction, Along);
      mean.Add(glm::length(ray.Exit + rest * ray.Direction - Along));
    });
  EXPECT_EQ(scene.Statistics.Lost + scene.Statistics.Trapped, 0);
  return mean.Get();
}

/** RMS distance of ends from circles in Maxwell's fish-eye, n = 2 / (1 + r^2). */
double FishEyeError(int n)
{
  GradedScene scene(CenteredGrid(n, 1.0),
    [](const glm::dvec3& p)
    {
      const double index = 2.0 / (1.0 + glm::dot(p, p));
      return index * index;
    });
  MeanError mean;
  ForEachOffset(0.6,
    [&](double x, double y)
    {
      const glm::dvec3 direction = glm::normalize(glm::dvec3(x, y, 1.0));
      const glm::dvec3 origin(0.31, -0.22, -1.0);
      const GradedRayResult ray = scene.Trace(origin - direction, direction);
      // All rays through a point meet again at its image: a circle through both, in their plane.
      const glm::dvec3 image = -origin / glm::dot(origin, origin);
      const glm::dvec3 chord = image - origin;
      const glm::dvec3 across = chord - glm::dot(chord, direction) * direction;
      const double radius = glm::dot(chord, chord) / (2.0 * glm::length(across));
      const glm::dvec3 middle = origin + radius * glm::normalize(across);
      const glm::dvec3 normal = glm::normalize(glm::cross(direction, across));
      const glm::dvec3 spoke = ray.Exit - middle;
      const double off = glm::dot(spoke, normal);
      mean.Add(std::hypot(off, glm::length(spoke - off * normal) - radius));
    });
  EXPECT_EQ(scene.Statistics.Lost + scene.Statistics.Trapped, 0);
  return mean.Get();
}

/** RMS error of the end of rays in a rod with n^2 = n0^2 (1 - g^2 r^2): sines in the parameter. */
double RodError(int n)
{
  const MeshArrays arrays = Moved(KuhnBlock(n, n, 3 * n, 2 * n),
    [](const glm::dvec3& p) { return p - glm::dvec3(0.25, 0.25, 0.0); });
  const double square = 2.25;
  const double g = 2.0;
  GradedScene scene(
    arrays, [=](const glm::dvec3& p) { return square * (1.0 - g * g * (p.x * p.x + p.y * p.y)); });
  MeanError mean;
  ForEachOffset(0.1,
    [&](double x, double y)
    {
      const glm::dvec3 direction = glm::normalize(glm::dvec3(0.2 * y, -0.1 * x, 1.0));
      const GradedRayResult ray = scene.Trace(glm::dvec3(x, y, 0.0) - 0.1 * direction, direction);
      const glm::dvec3 entry = ray.Entry;
      const glm::dvec3 momentum =
        direction * std::sqrt(square * (1.0 - g * g * (entry.x * entry.x + entry.y * entry.y)));
      // d2x/ds2 = -n0^2 g^2 x, dz/ds constant.
      const double time = ray.Exit.z / momentum.z;
      const double rate = std::sqrt(square) * g;
      mean.Add(std::hypot(
        entry.x * std::cos(rate * time) + momentum.x / rate * std::sin(rate * time) - ray.Exit.x,
        entry.y * std::cos(rate * time) + momentum.y / rate * std::sin(rate * time) - ray.Exit.y));
    });
  EXPECT_EQ(scene.Statistics.Lost + scene.Statistics.Trapped, 0);
  return mean.Get();
}

/** RMS change of Bouguer's invariant |r x p| in a field of r^2. */
template <typename Function>
double BouguerError(int n, Function&& squareOf)
{
  const auto squareAt = [&](const glm::dvec3& p) { return squareOf(glm::dot(p, p)); };
  GradedScene scene(CenteredGrid(n, 1.0), squareAt);
  MeanError mean;
  ForEachOffset(0.7,
    [&](double x, double y)
    {
      const glm::dvec3 direction = glm::normalize(glm::dvec3(0.2, 0.1, 1.0));
      const GradedRayResult ray = scene.Trace(glm::dvec3(x, y, 0.0) - 3.0 * direction, direction);
      const auto invariant = [&](const glm::dvec3& place, const glm::dvec3& along)
      { return std::sqrt(squareAt(place)) * glm::length(glm::cross(place, along)); };
      mean.Add(invariant(ray.Exit, ray.Direction) - invariant(ray.Entry, direction));
    });
  EXPECT_EQ(scene.Statistics.Lost + scene.Statistics.Trapped, 0);
  return mean.Get();
}

}

TEST(GradedLenses, LuneburgFocuses)
{
  const double errors[3] = { LuneburgError(Sizes[0]), LuneburgError(Sizes[1]),
    LuneburgError(Sizes[2]) };
  // The field is exact but for its end, a sphere, at the faces of which n^2 jumps by up to h^2 / 4.
  EXPECT_GT(OrderOf(errors), 1.95);
  EXPECT_LT(errors[2], 5.0e-4);
}

TEST(GradedLenses, FishEyeHasCircles)
{
  const double errors[3] = { FishEyeError(Sizes[0]), FishEyeError(Sizes[1]),
    FishEyeError(Sizes[2]) };
  EXPECT_GT(OrderOf(errors), 2.0);
  EXPECT_LT(errors[2], 1.0e-3);
}

TEST(GradedLenses, RodHasSines)
{
  // The field is exact: the positions of the mesh are rounded by up to 2^-31.
  for (const int n : { 3, 7, 14 })
  {
    EXPECT_LT(RodError(n), 1.0e-8) << n;
  }
}

TEST(GradedLenses, BouguersInvariantIsKept)
{
  double errors[3];
  for (int k = 0; k < 3; ++k)
  {
    errors[k] = BouguerError(Sizes[k], [](double square) { return 1.0 + std::exp(-2.0 * square); });
  }
  EXPECT_GT(OrderOf(errors), 2.0);
  // Quadratic fields are exact; a ray crosses 100 cells.
  EXPECT_LT(BouguerError(36, [](double square) { return 2.5 - 0.5 * square; }), 1.0e-7);
}

// The deflection of a straight ray is the integral of grad(n) / n across it.
TEST(GradedLenses, SmallBendingIsTheStraightIntegral)
{
  double differences[3];
  double strength = 0.08;
  for (double& difference : differences)
  {
    GradedScene scene(CenteredGrid(12, 1.0),
      [=](const glm::dvec3& p) { return 1.0 + strength * std::exp(-4.0 * glm::dot(p, p)); });
    scene.Trace(glm::dvec3(0.31, 0.17, -2.0), glm::dvec3(0.0, 0.0, 1.0));
    GradedScene weak(CenteredGrid(12, 1.0),
      [=](const glm::dvec3& p) { return 1.0 + 1.0e-6 * std::exp(-4.0 * glm::dot(p, p)); });
    const glm::dvec3 bent =
      scene.Trace(glm::dvec3(0.31, 0.17, -2.0), glm::dvec3(0.0, 0.0, 1.0)).Direction;
    const glm::dvec3 slight =
      weak.Trace(glm::dvec3(0.31, 0.17, -2.0), glm::dvec3(0.0, 0.0, 1.0)).Direction;
    difference = std::abs(bent.x - strength / 1.0e-6 * slight.x);
    strength *= 0.5;
  }
  EXPECT_GT(std::log2(differences[0] / differences[1]), 1.75);
  EXPECT_GT(std::log2(differences[1] / differences[2]), 1.75);
}
