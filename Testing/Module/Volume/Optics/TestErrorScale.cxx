// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Errors of scalars as a picture shows them: closed forms, and the colours of rays through fields
// that are off by a given error.
#include "TestBasics.h"
#include "Volume/Optics/ErrorScale.h"

using namespace meniscus;

namespace
{

PictureFunction MakeFunction(ScalarUse use, std::vector<TransferFunctionPoint> points)
{
  PictureFunction function;
  function.Use = use;
  function.Points = std::move(points);
  return function;
}

/** Colour and attenuation of a scalar, evaluated in their own way. */
TransferFunctionPoint Evaluate(const std::vector<TransferFunctionPoint>& points, double scalar)
{
  if (scalar <= points.front().Scalar)
  {
    return points.front();
  }
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    if (scalar < points[i].Scalar)
    {
      const TransferFunctionPoint& a = points[i - 1];
      const TransferFunctionPoint& b = points[i];
      const double t = (scalar - a.Scalar) / (b.Scalar - a.Scalar);
      return { scalar, glm::mix(a.Attenuation, b.Attenuation, t), glm::mix(a.Color, b.Color, t) };
    }
  }
  return points.back();
}

/** Colour of a ray of length 1 through a field. */
glm::dvec3 Integrate(
  const std::vector<TransferFunctionPoint>& points, const std::function<double(double)>& field)
{
  constexpr int steps = 4000;
  glm::dvec3 color(0.0);
  double transparency = 1.0;
  for (int i = 0; i < steps; ++i)
  {
    const TransferFunctionPoint at = Evaluate(points, field((i + 0.5) / steps));
    const double behind = transparency * std::exp(-at.Attenuation / steps);
    color += (transparency - behind) * at.Color;
    transparency = behind;
  }
  return color;
}

}

TEST(ErrorScale, ValuesAreFractionsOfTheirRange)
{
  const ErrorScale scale = PictureFunction().MakeScale(1.0, 4.0);
  EXPECT_DOUBLE_EQ(scale.Measure(1.0, 2.0), 0.25);
  EXPECT_DOUBLE_EQ(scale.Bound(0.0, 4.0, 1.0), 0.25);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : { inf, -inf, std::nan("") })
  {
    EXPECT_EQ(scale.Measure(1.0, bad), 0.0);
  }
  // A constant has no range, and no errors.
  EXPECT_EQ(PictureFunction().MakeScale(1.0, 0.0).Measure(1.0, 2.0), 0.0);
}

TEST(ErrorScale, MediaHaveClosedForms)
{
  // Attenuation from 0 to 8 over a unit length, one colour: the logarithm of 1 + depth.
  const glm::dvec3 white(1.0);
  const ErrorScale gray = MakeFunction(ScalarUse::Medium,
    { { 0.0, 0.0, white },
      { 2.0, 8.0, white } }).MakeScale(1.0, 2.0);
  EXPECT_NEAR(gray.Measure(0.0, 2.0), std::log(9.0), 1e-12);
  // The scale is linear between depths with a ratio of 1.5.
  EXPECT_NEAR(gray.Measure(0.5, 1.0), std::log(5.0 / 3.0), 0.02);
  // Nothing changes outside of the points.
  EXPECT_EQ(gray.Measure(-1.0, 0.0), 0.0);
  EXPECT_EQ(gray.Measure(2.0, 7.0), 0.0);
  // A colour that changes from black to white at the depth 3: weighted by 3 / 4.
  const ErrorScale colored = MakeFunction(ScalarUse::Medium,
    { { 0.0, 3.0, glm::dvec3(0.0) },
      { 1.0, 3.0, white } }).MakeScale(1.0, 1.0);
  EXPECT_NEAR(colored.Measure(0.0, 1.0), 0.75, 1e-12);
  EXPECT_NEAR(colored.Measure(0.25, 0.75), 0.375, 1e-12);
  // Without attenuation nothing is seen; without points neither.
  EXPECT_EQ(MakeFunction(ScalarUse::Medium, { { 0.0, 0.0, glm::dvec3(0.0) }, { 1.0, 0.0, white } })
              .MakeScale(1.0, 1.0)
              .Measure(0.0, 1.0),
    0.0);
  EXPECT_EQ(MakeFunction(ScalarUse::Medium, {}).MakeScale(1.0, 1.0).Measure(0.0, 1.0), 0.0);
}

TEST(ErrorScale, JumpsAndSurfaces)
{
  const glm::dvec3 white(1.0);
  const ErrorScale jump = MakeFunction(ScalarUse::Colors,
    { { 0.0, 0.2, white }, { 1.0, 0.2, white },
      { 1.0, 0.9, white } }).MakeScale(1.0, 1.0);
  EXPECT_NEAR(jump.Measure(0.999, 1.001), 0.7, 1e-12);
  EXPECT_EQ(jump.Measure(0.2, 0.9), 0.0);
  EXPECT_NEAR(jump.Bound(0.9, 0.95, 0.2), 0.7, 1e-12);
  EXPECT_EQ(jump.Bound(0.2, 0.5, 0.1), 0.0);
  const ErrorScale surfaces = MakeFunction(ScalarUse::Surfaces,
    { { 5.0, 0.5, white },
      { 1.0, 1.0, white } }).MakeScale(1.0, 1.0);
  EXPECT_EQ(surfaces.Measure(2.0, 4.0), 0.0);
  EXPECT_NEAR(surfaces.Measure(0.0, 2.0), 1.0, 1e-12);
  EXPECT_NEAR(surfaces.Measure(0.0, 9.0), 1.5, 1e-12);
}

TEST(ErrorScale, RaysAreWithinTheirBounds)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double largest = 0.0;
  for (int round = 0; round < 30; ++round)
  {
    std::vector<TransferFunctionPoint> points;
    const double density = std::pow(10.0, 3.0 * unit(random) - 1.0);
    for (const double scalar : { 0.0, 0.3, 0.6, 1.0 })
    {
      const double attenuation = unit(random) < 0.3 ? 0.0 : density * unit(random);
      points.push_back({ scalar, attenuation, { unit(random), unit(random), unit(random) } });
    }
    const ErrorScale scale = MakeFunction(ScalarUse::Medium, points).MakeScale(1.0, 1.0);
    const double phase = 6.0 * unit(random);
    const auto field = [phase](double x) { return 0.5 + 0.5 * std::sin(5.0 * x + phase); };
    constexpr double error = 0.01;
    // Moved up, as far as the error allows.
    const auto moved = [&](double x)
    {
      double low = field(x);
      double high = low + 1.0;
      for (int i = 0; i < 20; ++i)
      {
        const double middle = 0.5 * (low + high);
        (scale.Measure(field(x), middle) <= error ? low : high) = middle;
      }
      return low;
    };
    const glm::dvec3 d = glm::abs(Integrate(points, field) - Integrate(points, moved));
    const double worst = std::max({ d.x, d.y, d.z });
    largest = std::max(largest, worst / error);
    // The bound 1 - t + s / length is at most 2; second order in the error, and the scale's ratio.
    EXPECT_LE(worst, 2.0 * error * 1.25) << "round " << round;
  }
  std::printf("largest difference of a ray: %.2f errors\n", largest);
  EXPECT_GE(largest, 0.3);
}
