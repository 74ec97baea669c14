// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Snell's law, its extrapolations and Fresnel's equations against closed forms.
#include "Refraction/Membrane/Optics.h"
#include "TestBasics.h"

#include <glm/trigonometric.hpp>

namespace
{

using namespace meniscus;

const glm::dvec3 Up(0.0, 1.0, 0.0);

// A dozen roundings of numbers below 2.
constexpr double Rounding = 24.0 * std::numeric_limits<double>::epsilon();

glm::dvec3 Sight(double angle)
{
  return { std::sin(angle), -std::cos(angle), 0.0 };
}

TEST(RefractionOptics, ObeysSnellsLaw)
{
  for (const double ratio : { 1.0 / 2.2, 1.0 / 1.333, 1.0, 1.333, 2.2 })
  {
    for (double angle = 0.0; angle < 1.55; angle += 0.05)
    {
      const double sine = ratio * std::sin(angle);
      if (sine >= 1.0)
      {
        continue;
      }
      const auto ray = ComputeRefractionRay(Sight(angle), Up, ratio);
      EXPECT_EQ(ray.Kind, RayKind::Refracted);
      EXPECT_NEAR(ray.Direction.x, sine, Rounding) << angle << " " << ratio;
      // The cosine loses accuracy near the critical angle as 1 / cosine.
      const double cosine = std::sqrt(1.0 - sine * sine);
      EXPECT_NEAR(ray.Direction.y, -cosine, Rounding / cosine) << angle << " " << ratio;
      EXPECT_EQ(ray.Direction.z, 0.0);
    }
  }
}

TEST(RefractionOptics, EqualIndicesDoNotRefract)
{
  const auto ray = ComputeRefractionRay(Sight(0.7), Up, 1.0);
  EXPECT_NEAR(glm::length(ray.Direction - Sight(0.7)), 0.0, Rounding);
}

TEST(RefractionOptics, BackFacingCountsAsGrazing)
{
  const glm::dvec3 sight = glm::normalize(glm::dvec3(0.8, 0.6, 0.0));
  const auto ray = ComputeRefractionRay(sight, Up, 0.5);
  EXPECT_EQ(ray.Kind, RayKind::BackFacing);
  // Eq. 3.1: D n1 / n2 - N sqrt(1 - n1^2 / n2^2), normalised.
  const glm::dvec3 expected = glm::normalize(0.5 * sight - std::sqrt(0.75) * Up);
  EXPECT_NEAR(glm::length(ray.Direction - expected), 0.0, Rounding);
}

TEST(RefractionOptics, TotalReflectionFlipsTheRoot)
{
  const double angle = 1.2;
  const double ratio = 1.5;
  const auto ray = ComputeRefractionRay(Sight(angle), Up, ratio);
  EXPECT_EQ(ray.Kind, RayKind::TotallyReflected);
  const double sine = ratio * std::sin(angle);
  const glm::dvec3 expected = glm::normalize(glm::dvec3(sine, std::sqrt(sine * sine - 1.0), 0.0));
  EXPECT_NEAR(glm::length(ray.Direction - expected), 0.0, Rounding);
  EXPECT_GT(ray.Direction.y, 0.0);
}

TEST(RefractionOptics, ExtrapolationJoinsAtTheCriticalAngle)
{
  const double ratio = 1.5;
  const double critical = std::asin(1.0 / ratio);
  const double step = 1e-9;
  const auto below = ComputeRefractionRay(Sight(critical - step), Up, ratio);
  const auto above = ComputeRefractionRay(Sight(critical + step), Up, ratio);
  EXPECT_EQ(below.Kind, RayKind::Refracted);
  EXPECT_EQ(above.Kind, RayKind::TotallyReflected);
  // Near the critical angle the cosine is sqrt(2 tan(critical) step).
  EXPECT_LT(glm::length(below.Direction - above.Direction),
    3.0 * std::sqrt(2.0 * std::tan(critical) * step));
}

TEST(RefractionOptics, FresnelAtNormalIncidence)
{
  EXPECT_NEAR(FresnelReflectance(1.0, 1.0, 1.5), 0.04, Rounding);
  EXPECT_NEAR(FresnelReflectance(1.0, 1.5, 1.0), 0.04, Rounding);
  EXPECT_NEAR(SchlickReflectance(1.0, 1.0, 1.5), 0.04, Rounding);
}

TEST(RefractionOptics, FresnelIsTheMeanOfBothPolarisations)
{
  for (const double n : { 1.1, 1.333, 1.51, 2.2, 1.0 / 1.333 })
  {
    for (double angle = 0.0; angle < 1.57; angle += 0.05)
    {
      const double sine = std::sin(angle) / n;
      if (sine >= 1.0)
      {
        EXPECT_EQ(FresnelReflectance(std::cos(angle), 1.0, n), 1.0);
        continue;
      }
      const double ci = std::cos(angle);
      const double ct = std::sqrt(1.0 - sine * sine);
      const double s = (ci - n * ct) / (ci + n * ct);
      const double p = (n * ci - ct) / (n * ci + ct);
      EXPECT_NEAR(FresnelReflectance(ci, 1.0, n), 0.5 * (s * s + p * p), 1e-12)
        << n << " " << angle;
    }
  }
}

TEST(RefractionOptics, FresnelLimits)
{
  EXPECT_NEAR(FresnelReflectance(0.0, 1.0, 1.5), 1.0, Rounding);
  EXPECT_EQ(FresnelReflectance(0.0, 1.5, 1.0), 1.0);
  EXPECT_EQ(FresnelReflectance(0.0, 1.333, 1.333), 0.0);
  EXPECT_EQ(FresnelReflectance(-0.5, 1.0, 1.5), FresnelReflectance(0.0, 1.0, 1.5));
  EXPECT_NEAR(SchlickReflectance(0.0, 1.0, 1.5), 1.0, Rounding);
}

TEST(RefractionOptics, PolarizedReflectancesHaveTheUnpolarisedOneAsTheirMean)
{
  for (const double interior : { 1.0, 1.333, 2.4, 0.75 })
  {
    for (double cosine = 0.0; cosine <= 1.0; cosine += 0.01)
    {
      const meniscus::PolarizedReflectance r =
        meniscus::ComputePolarizedReflectance(cosine, 1.0, interior);
      EXPECT_NEAR(0.5 * (r.Across + r.Within), FresnelReflectance(cosine, 1.0, interior), 1.0e-13);
    }
  }
}

/** A pane of glass in air: (1 - R) / (1 + R) for each polarisation. */
TEST(RefractionOptics, APaneTransmitsWithAllReflectionsInIt)
{
  const std::pair<double, double> expected[] = { { 0.0, 0.9231 }, { 45.0, 0.9074 },
    { 60.0, 0.8481 }, { 75.0, 0.6182 } };
  for (const auto& [degrees, share] : expected)
  {
    const double cosine = std::cos(glm::radians(degrees));
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (1.5 * 1.5));
    const meniscus::PolarizedReflectance r =
      meniscus::ComputePolarizedReflectance(cosine, 1.0, 1.5);
    meniscus::PlateTransmittance pane;
    pane.Add(cosine, 1.0, 1.5);
    EXPECT_NEAR(pane.Get(), 1.0 - FresnelReflectance(cosine, 1.0, 1.5), Rounding);
    pane.Add(inside, 1.5, 1.0);
    EXPECT_NEAR(pane.Get(), share, 1.0e-4);
    EXPECT_NEAR(pane.Get(),
      0.5 * ((1.0 - r.Across) / (1.0 + r.Across) + (1.0 - r.Within) / (1.0 + r.Within)), Rounding);
    // m panes transmit (1 - R) / (1 + (2 m - 1) R).
    pane.Add(cosine, 1.0, 1.5);
    pane.Add(inside, 1.5, 1.0);
    EXPECT_NEAR(pane.Get(),
      0.5 * ((1.0 - r.Across) / (1.0 + 3.0 * r.Across) + (1.0 - r.Within) / (1.0 + 3.0 * r.Within)),
      Rounding);
  }
}

TEST(RefractionOptics, NothingPassesATotalReflection)
{
  meniscus::PlateTransmittance plates;
  plates.Add(0.0, 1.0, 1.5); // grazing
  EXPECT_EQ(plates.Get(), 0.0);
  plates.Add(0.1, 1.5, 1.0);
  EXPECT_EQ(plates.Get(), 0.0);
  meniscus::PlateTransmittance beyond;
  beyond.Add(0.1, 1.5, 1.0);
  beyond.Add(0.5, 1.0, 1.5);
  EXPECT_EQ(beyond.Get(), 0.0);
}

}
