// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The stress programme's oracle against bracketed roots on a sphere and a dense search on waves.
#include "AnalyticMembrane.h"
#include "HeightField.h"
#include "RefractionTestRandom.h"
#include "SightOracle.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus::reference;
using meniscus::test::Random;

constexpr SurfaceError Exact{ 1e-12, 1e-12 };

// Number of differences of the two lists, except for their order and for the roots that either of
// them may leave out.
int CountDifferences(const OracleAnswer& answer, const std::vector<glm::dvec3>& others, double same)
{
  int differences = 0;
  for (const OracleImage& image : answer.Images)
  {
    differences += std::none_of(others.begin(), others.end(),
      [&](const glm::dvec3& s) { return glm::length(s - image.Sight) < same; });
  }
  for (const glm::dvec3& s : others)
  {
    differences += !answer.IsUncertain(s.x, s.z, same) &&
      std::none_of(answer.Images.begin(), answer.Images.end(),
        [&](const OracleImage& image) { return glm::length(s - image.Sight) < same; });
  }
  return differences;
}

//------------------------------------------------------------------------------
TEST(RefractionOracle, AgreesWithBracketedRootsOnASphere)
{
  SmoothSurface surface;
  surface.SphereRadius = 200.0;
  Random random(7);
  int images = 0;
  for (const double ratio : { 1.0 / 1.51, 1.6 })
  {
    const AnalyticMembrane sphere{ 200.0, ratio, 1.0 };
    const glm::dvec3 eye(20.0, 260.0, 10.0);
    const SightOracle oracle(surface, eye, ratio, 1.0, Exact);
    for (int i = 0; i < 200; ++i)
    {
      const glm::dvec3 point(random(-90, 90), random(-300, -20), random(-90, 90));
      std::vector<glm::dvec3> expected;
      for (const glm::dvec3& s : sphere.FindSightPoints(eye, point))
      {
        if (std::max(std::fabs(s.x), std::fabs(s.z)) < 100.0)
        {
          expected.push_back(s);
        }
      }
      const OracleAnswer answer = oracle.Find(point);
      EXPECT_TRUE(answer.Complete);
      EXPECT_EQ(CountDifferences(answer, expected, 1e-6), 0) << i;
      images += static_cast<int>(answer.Images.size());
    }
  }
  EXPECT_GT(images, 200);
}

//------------------------------------------------------------------------------
TEST(RefractionOracle, AgreesWithADenseSearchOnWaves)
{
  const double k = 0.03 * std::acos(-1.0);
  const HeightField field{ HeightField::Shape::Waves, 200.0, 5.0, k, 1.0, 1.333 };
  // sin(kx) sin(kz) as a sum of two waves.
  SmoothSurface surface;
  const double quarter = 0.5 * std::acos(-1.0);
  surface.Waves = { { 2.5, k, -k, quarter }, { -2.5, k, k, quarter } };
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const SightOracle oracle(surface, eye, 1.0, 1.333, Exact);
  Random random(7);
  int several = 0;
  for (int i = 0; i < 120; ++i)
  {
    const glm::dvec3 point(random(-80, 80), random(-250, -40), random(-80, 80));
    const OracleAnswer answer = oracle.Find(point);
    EXPECT_TRUE(answer.Complete);
    EXPECT_EQ(CountDifferences(answer, field.FindSightPoints(eye, point, 250), 1e-6), 0) << i;
    several += answer.Images.size() > 1;
  }
  EXPECT_GT(several, 5);
}

//------------------------------------------------------------------------------
// With an error of the surface, certain answers must hold on every surface within that error, and
// fewer answers are certain closer to a caustic.
TEST(RefractionOracle, DoubtGrowsWithTheError)
{
  SmoothSurface surface;
  surface.Hills = { { 30.0, 0.025, 0.0, 0.0 } };
  const glm::dvec3 eye(5.0, 400.0, 3.0);
  const SightOracle exact(surface, eye, 1.0, 1.5, Exact);
  const SightOracle doubtful(surface, eye, 1.0, 1.5, { 1e-3, 1e-3 });
  Random random(7);
  std::size_t certain = 0;
  std::size_t stillCertain = 0;
  for (int i = 0; i < 100; ++i)
  {
    const glm::dvec3 point(random(-20, 20), random(-300, -40), random(-20, 20));
    const OracleAnswer sharp = exact.Find(point);
    const OracleAnswer vague = doubtful.Find(point);
    certain += sharp.Images.size();
    stillCertain += vague.Images.size();
    for (const OracleImage& image : vague.Images)
    {
      EXPECT_TRUE(std::any_of(sharp.Images.begin(), sharp.Images.end(),
        [&](const OracleImage& other)
        { return glm::length(other.Sight - image.Sight) < image.Radius + 1e-9; }));
    }
    for (const OracleImage& image : sharp.Images)
    {
      EXPECT_TRUE(vague.IsUncertain(image.Sight.x, image.Sight.z, 1e-9) ||
        std::any_of(vague.Images.begin(), vague.Images.end(),
          [&](const OracleImage& other) { return glm::length(other.Sight - image.Sight) < 1e-9; }));
    }
  }
  EXPECT_LT(stillCertain, certain);
  EXPECT_GT(stillCertain, certain / 4);
}
}
