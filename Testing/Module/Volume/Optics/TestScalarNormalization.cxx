// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Distribution of the precision of normalised scalars.
#include "TestBasics.h"
#include "Volume/Optics/ScalarNormalization.h"
#include "Volume/Optics/TransferFunction.h"

using namespace meniscus;

namespace
{

/** Evenly spaced from 0 to 1, and some others. */
std::vector<double> Scalars(const std::vector<double>& others = {})
{
  std::vector<double> scalars;
  for (int i = 0; i <= 1000; ++i)
  {
    scalars.push_back(i / 1000.0);
  }
  scalars.insert(scalars.end(), others.begin(), others.end());
  return scalars;
}

ScalarDistribution DistributionOf(const std::vector<double>& scalars)
{
  const auto range = std::minmax_element(scalars.begin(), scalars.end());
  return { *range.first, *range.second, scalars };
}

/** Changes from `first` to `last` in four pieces. */
std::vector<ScalarFeature> Ramp(double first, double last)
{
  std::vector<TransferFunctionPoint> points;
  for (int i = 0; i <= 4; ++i)
  {
    points.push_back({ first + 0.25 * i * (last - first), 0.1 * i, glm::dvec3(0.0) });
  }
  return FeaturesOf(points);
}

/** Largest error, in scalars, of scalars in [0, 1] stored as normalised floats. */
double LargestError(const ScalarNormalization& normalization, double first, double last)
{
  double largest = 0.0;
  for (int i = 0; i <= 100; ++i)
  {
    const double scalar = first + i / 100.0 * (last - first);
    const double exact = (scalar - normalization.Offset) * normalization.Scale;
    const double kept = static_cast<float>(normalization(scalar));
    largest = std::max(largest, std::abs(kept - exact) / normalization.Scale);
  }
  return largest;
}

const std::vector<double> FillValues = { 1.0e6, -1.0e6, 1.0e10, 1.0e20, -1.0e20, 9.97e36, -1.0e36,
  1.0e38, 1.0e300, -1.0e308 };

}

TEST(ScalarNormalization, OrdinaryDataMapsItsRange)
{
  const ScalarDistribution data = DistributionOf(Scalars());
  const ScalarNormalization ofRange = NormalizeRange(0.0, 1.0);
  EXPECT_EQ(ChooseNormalization(data, {}, nullptr), ofRange);
  EXPECT_EQ(ChooseNormalization(data, Ramp(0.0, 1.0), nullptr), ofRange);
  EXPECT_EQ(ChooseNormalization(data, Ramp(0.4, 0.45), nullptr), ofRange);
  // Nodes outside the range of the data, isovalues, a jump.
  EXPECT_EQ(ChooseNormalization(data, Ramp(100.0, 101.0), nullptr), ofRange);
  EXPECT_EQ(ChooseNormalization(data, { { 0.3, 0.0 }, { 0.9, 0.0 } }, nullptr), ofRange);
  EXPECT_EQ(ChooseNormalization(DistributionOf({ 5.0, 5.0 }), { { 5.0, 0.0 } }, nullptr),
    NormalizeRange(5.0, 5.0));
}

TEST(ScalarNormalization, DenormalScalarsKeepTheirProportions)
{
  const double smallest = std::numeric_limits<double>::denorm_min();
  for (const double step : { smallest, 40.0 * smallest, 1.0e-310 })
  {
    const ScalarNormalization normalization = NormalizeRange(0.0, 16.0 * step);
    const auto normalized = [&](int steps) -> double
    { return static_cast<float>(normalization(steps * step)); };
    const double width = normalized(16) - normalized(0);
    EXPECT_GT(width, 0.0);
    for (int steps = 0; steps <= 16; ++steps)
    {
      EXPECT_NEAR((normalized(steps) - normalized(0)) / width, steps / 16.0, 1.0e-6) << step;
    }
  }
}

TEST(ScalarNormalization, FillValuesLeaveTheFunctionItsPrecision)
{
  for (const double fill : FillValues)
  {
    for (const auto& features :
      { Ramp(0.0, 1.0), Ramp(0.2, 0.3), std::vector<ScalarFeature>{ { 0.5, 0.0 } } })
    {
      const ScalarDistribution data = DistributionOf(Scalars({ fill }));
      const ScalarNormalization normalization = ChooseNormalization(data, features, nullptr);
      // Within 2^-24 of the distance from an offset among the features.
      EXPECT_LE(LargestError(normalization, 0.0, 1.0), 6.0e-8) << fill;
      EXPECT_LE(std::abs(normalization(fill)), 1.0) << fill;
      EXPECT_GE(std::abs(normalization(fill)), 0.999) << fill;
      // Large enough for products with areas.
      EXPECT_GT(normalization.Scale, std::ldexp(1.0, -64)) << fill;
    }
  }
}

TEST(ScalarNormalization, FillValuesOfBothSignsAboutTheFunction)
{
  // The function changes in the middle of the range; its unit would be too large.
  const ScalarDistribution data = DistributionOf(Scalars({ 1.0e36, -1.0e36 }));
  const ScalarNormalization normalization = ChooseNormalization(data, Ramp(0.0, 1.0), nullptr);
  EXPECT_GT(normalization.Scale, std::ldexp(1.0, -64));
  EXPECT_EQ(normalization(1.0e36), 1.0);
  EXPECT_EQ(normalization(-1.0e36), -1.0);
  EXPECT_LE(LargestError(normalization, 0.0, 1.0), 6.0e-8);
}

TEST(ScalarNormalization, AscendsAndKeepsProportionsOfFarScalars)
{
  for (const double below : { -1.0e30, -1.0e36, -1.0e25 })
  {
    const double above = 1.0e36;
    const ScalarDistribution data = DistributionOf(Scalars({ below, above }));
    const ScalarNormalization normalization = ChooseNormalization(data, Ramp(0.0, 1.0), nullptr);
    double last = -std::numeric_limits<double>::infinity();
    for (double exponent = 37.0; exponent > -4.0; exponent -= 0.25)
    {
      const double now = normalization(-std::pow(10.0, exponent));
      EXPECT_GE(now, last);
      last = now;
    }
    for (double exponent = -4.0; exponent < 37.0; exponent += 0.25)
    {
      const double now = normalization(std::pow(10.0, exponent));
      EXPECT_GE(now, last);
      last = now;
    }
    // A segment between the two passes the function at the right place, to 2^-16 of its length.
    const double exact = -below / (above - below);
    const double low = normalization(below);
    EXPECT_NEAR(-low / (normalization(above) - low), exact, 1.0 / 65536.0) << below;
  }
}

TEST(ScalarNormalization, ScalarsBetweenFunctionAndFillStayWhatTheyAre)
{
  // Cells between -1000 and 3000 show an isovalue of 0 at a quarter of their length, with noise
  // around it.
  std::vector<double> scalars = Scalars({ 1.0e36 });
  for (double& scalar : scalars)
  {
    scalar = scalar < 0.3 ? 1.0e-17 * scalar : (scalar <= 1.0 ? 4000.0 * scalar - 1000.0 : scalar);
  }
  const ScalarNormalization normalization =
    ChooseNormalization(DistributionOf(scalars), { { 0.0, 0.0 } }, nullptr);
  const double low = normalization(-1000.0);
  const double high = normalization(3000.0);
  EXPECT_NEAR((normalization(0.0) - low) / (high - low), 0.25, 1e-7);
}

TEST(ScalarNormalization, FunctionFromDataToFillValue)
{
  // Opacity changes in [0, 1], colour up to the fill value: both must be resolved.
  const ScalarDistribution data = DistributionOf(Scalars({ 1.0e12 }));
  std::vector<ScalarFeature> features = Ramp(0.0, 1.0);
  features.push_back({ 0.0, 1.0e12 });
  features.push_back({ 1.0e12, 1.0e12 });
  const ScalarNormalization normalization = ChooseNormalization(data, features, nullptr);
  EXPECT_LE(LargestError(normalization, 0.0, 1.0), 6.0e-8);
  EXPECT_NEAR(normalization(5.0e11) / normalization(1.0e12), 0.5, 1e-6);
}

TEST(ScalarNormalization, EditsKeepItWhileItServes)
{
  const ScalarDistribution data = DistributionOf(Scalars({ 1.0e20 }));
  ScalarNormalization now = ChooseNormalization(data, Ramp(0.0, 1.0), nullptr);
  int changes = 0;
  // A node, and then an isovalue, moved through the data in 1000 steps each.
  for (int i = 1; i <= 2000; ++i)
  {
    const double at = (i % 1000) / 1000.0;
    std::vector<ScalarFeature> features{ { at, 0.0 } };
    if (i <= 1000)
    {
      features = FeaturesOf({ { 0.0, 0.0, glm::dvec3(0.0) }, { at, 1.0, glm::dvec3(0.0) },
        { 1.0, 0.5, glm::dvec3(1.0) } });
    }
    const ScalarNormalization next = ChooseNormalization(data, features, &now);
    changes += next != now ? 1 : 0;
    now = next;
    EXPECT_LE(LargestError(now, 0.0, 1.0), 1.2e-7);
  }
  EXPECT_EQ(changes, 0);
  // To other scalars and back: one change each.
  now = ChooseNormalization(data, Ramp(1.0e19, 2.0e19), &now);
  EXPECT_EQ(now, NormalizeRange(0.0, 1.0e20));
  now = ChooseNormalization(data, Ramp(0.0, 1.0), &now);
  EXPECT_LE(LargestError(now, 0.0, 1.0), 6.0e-8);
}

TEST(ScalarNormalization, MostOfTheDataMayBeFillValues)
{
  const ScalarDistribution data = DistributionOf(Scalars(std::vector<double>(20000, 1.0e20)));
  for (const auto& features : { Ramp(0.0, 1.0), std::vector<ScalarFeature>{ { 0.5, 0.0 } } })
  {
    EXPECT_LE(LargestError(ChooseNormalization(data, features, nullptr), 0.0, 1.0), 6.0e-8);
  }
}

TEST(ScalarNormalization, NothingFinite)
{
  EXPECT_EQ(
    ChooseNormalization(ScalarDistribution(), Ramp(0.0, 1.0), nullptr), ScalarNormalization());
  EXPECT_EQ(ScalarDistribution().SpacingAt(0.0), 0.0);
  EXPECT_EQ(DistributionOf({ 2.0 }).SpacingAt(2.0), 0.0);
}

TEST(ScalarNormalization, TablesSampleWhereTheFunctionChanges)
{
  const ScalarDistribution data = DistributionOf(Scalars({ 1.0e20 }));
  const auto features = Ramp(0.0, 1.0);
  const ScalarNormalization normalization = ChooseNormalization(data, features, nullptr);
  const ScalarRange range = SampledRange(data, features, normalization);
  EXPECT_EQ(range.Lowest, normalization(0.0));
  EXPECT_EQ(range.Highest, normalization(1.0));
  const ScalarRange whole = SampledRange(data, {}, normalization);
  EXPECT_EQ(whole.Highest, normalization(1.0e20));
}
