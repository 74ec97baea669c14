// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Entries of the pre-integration table compared with the integrals that they represent.
#include "KernelMeshes.h"

#include "TestBasics.h"
#include "Volume/Optics/PreIntegration.h"

#include <thread>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

std::vector<TransferFunctionInterval> Intervals(const std::vector<TransferFunctionPoint>& points)
{
  return BuildIntervals(points, ScalarNormalization());
}

/** A smooth, moderately dense function with many colours. */
std::vector<TransferFunctionInterval> Ramps()
{
  return Intervals({ { -1.0, 0.5, { 1.0, 0.2, 0.0 } }, { -0.3, 2.0, { 0.1, 0.9, 0.3 } },
    { 0.25, 1.0, { 0.2, 0.1, 1.0 } }, { 1.0, 4.0, { 1.0, 1.0, 0.2 } } });
}

const TransferFunctionInterval& IntervalOf(
  const std::vector<TransferFunctionInterval>& intervals, double scalar)
{
  return *std::find_if(intervals.begin(), intervals.end(),
    [scalar](const TransferFunctionInterval& i) { return scalar <= i.Upper; });
}

struct Segment
{
  glm::dvec3 Color{ 0.0 };
  double Opacity = 0.0;
};

/** The integral by the midpoint rule with many steps, in double precision. */
Segment Integrate(
  const std::vector<TransferFunctionInterval>& intervals, double front, double back, double length)
{
  constexpr int steps = 20000;
  Segment segment;
  for (int i = 0; i < steps; ++i)
  {
    const double scalar = front + (back - front) * (i + 0.5) / steps;
    const TransferFunctionInterval& interval = IntervalOf(intervals, scalar);
    const double offset = scalar - interval.Lower;
    const double depth =
      (interval.Attenuation + offset * interval.AttenuationSlope) * length / steps;
    const double gone = (1.0 - segment.Opacity) * -std::expm1(-depth);
    segment.Color += gone * (glm::dvec3(interval.Color) + offset * glm::dvec3(interval.ColorSlope));
    segment.Opacity += gone;
  }
  return segment;
}

struct Errors
{
  double Color = 0.0;
  double Opacity = 0.0;
};

/** Largest errors over some entries of a table, interpolated as in the shader. */
Errors LargestErrors(const PreIntegrationTable& table,
  const std::vector<TransferFunctionInterval>& intervals, int scalarStep, int lengthStep)
{
  Errors largest;
  const int count = table.GetNumberOfScalars();
  for (int k = 0; k < table.GetNumberOfLengths(); k += lengthStep)
  {
    const double length = table.GetLength(k);
    for (int b = 0; b < count; b += scalarStep)
    {
      for (int f = 0; f < count; f += scalarStep)
      {
        const float* entry = &table.GetValues()[4 * ((std::size_t(k) * count + b) * count + f)];
        const Segment truth =
          Integrate(intervals, -1.0 + 2.0 * f / (count - 1), -1.0 + 2.0 * b / (count - 1), length);
        const double opacity = -std::expm1(-entry[3] * length);
        largest.Opacity = std::max(largest.Opacity, std::abs(opacity - truth.Opacity));
        for (int c = 0; c < 3; ++c)
        {
          largest.Color = std::max(largest.Color, std::abs(opacity * entry[c] - truth.Color[c]));
        }
      }
    }
  }
  return largest;
}

}

TEST(PreIntegration, OpacityIsExactAndColorConverges)
{
  const auto intervals = Ramps();
  double last = 0.0;
  for (const int scalars : { 17, 33, 65, 129 })
  {
    PreIntegrationTable table;
    table.Build(intervals, 3.0, scalars, 16);
    EXPECT_EQ(table.GetNumberOfLengths(), 16);
    const Errors errors = LargestErrors(table, intervals, (scalars - 1) / 8, 5);
    // The error of the midpoint rule is below 1e-8; entries are floats.
    EXPECT_LT(errors.Opacity, 1e-6) << scalars;
    // Nodes between samples are kinks, at which interpolation is of first order in their distance
    // in the worst case; elsewhere it is of second order.
    EXPECT_TRUE(last == 0.0 || errors.Color < 0.6 * last) << scalars << ": " << errors.Color;
    last = errors.Color;
    RecordProperty("color error of " + std::to_string(scalars), std::to_string(errors.Color));
  }
  EXPECT_LT(last, 5e-4);
}

TEST(PreIntegration, LinearColorInConstantMediumIsExact)
{
  // Without kinks the colour over opacity is linear in both scalars: interpolation is exact.
  const auto intervals =
    Intervals({ { -1.0, 2.0, { 0.0, 1.0, 0.5 } }, { 1.0, 2.0, { 1.0, 0.0, 0.5 } } });
  PreIntegrationTable table;
  table.Build(intervals, 2.0, 9, 12);
  const Errors errors = LargestErrors(table, intervals, 1, 1);
  EXPECT_LT(errors.Color, 1e-6);
  EXPECT_LT(errors.Opacity, 1e-6);
}

TEST(PreIntegration, LengthsAreZeroAndAGeometricSequence)
{
  PreIntegrationTable table;
  table.Build(Ramps(), 5.0, 4, 20);
  ASSERT_EQ(table.GetNumberOfLengths(), 20);
  EXPECT_EQ(table.GetLength(0), 0.0);
  EXPECT_EQ(table.GetLength(1), table.GetShortest());
  EXPECT_NEAR(table.GetLength(19), 5.0, 1e-12);
  EXPECT_EQ(table.GetLongest(), 5.0);
  EXPECT_NEAR(table.GetLength(1 + table.GetLengthsPerOctave()), 2.0 * table.GetShortest(), 1e-12);
  // Fine enough for the lengths of a depth of 4 * 5 to begin at 1/16 or above.
  EXPECT_GE(table.GetLengthsPerOctave(), 2);
}

TEST(PreIntegration, OneLengthWhereTheModelAllowsIt)
{
  PreIntegrationTable table;
  // One colour wherever there is attenuation.
  const auto oneColor = Intervals({ { -1.0, 0.0, { 0.2, 0.4, 0.6 } },
    { 0.0, 3.0, { 0.2, 0.4, 0.6 } }, { 1.0, 0.5, { 0.2, 0.4, 0.6 } } });
  table.Build(oneColor, 4.0, 33, 16);
  EXPECT_EQ(table.GetNumberOfLengths(), 1);
  // Segments so short that their self-absorption is negligible.
  table.Build(Ramps(), 0.003, 33, 16);
  EXPECT_EQ(table.GetNumberOfLengths(), 1);
  table.Build(oneColor, 4.0, 33, 16);
  for (const double length : { 0.01, 1.0, 4.0 })
  {
    const float* entry = &table.GetValues()[4 * (24 * 33 + 3)];
    const Segment truth = Integrate(oneColor, -1.0 + 3 / 16.0, 0.5, length);
    const double opacity = -std::expm1(-entry[3] * length);
    EXPECT_NEAR(opacity, truth.Opacity, 1e-6);
    EXPECT_NEAR(opacity * entry[0], truth.Color.r, 1e-6);
    EXPECT_NEAR(opacity * entry[2], truth.Color.b, 1e-6);
  }
  EXPECT_EQ(table.GetLength(0), 0.0);
}

TEST(PreIntegration, ExtremeFunctionsGiveFiniteTables)
{
  const double huge = 1e37;
  const std::vector<std::vector<TransferFunctionPoint>> functions{ {},
    { { 0.1, 0.0, { 1, 1, 1 } } },
    { { 0.0, 0.0, { 1, 0, 0 } }, { 0.0, huge, { 0, 1, 0 } }, { 0.5, 1.0, { 0, 0, 1 } } },
    { { -50.0, 3.0, { 1, 0, 0 } }, { -40.0, 0.0, { 0, 1, 0 } } },
    { { 2.0, 1.0, { 1, 0, 0 } }, { 3.0, huge, { 0, 1, 0 } } },
    // A colour that changes within less than the smallest normal number.
    { { 0.0, 1.0, { 0, 0, 0 } }, { 1e-43, 1.0, { 0, 1, 0 } } },
    // An attenuation that exceeds all floats, a long way off.
    { { -4.0, 4.0, { 1, 0, 0 } }, { 1e9, 1e308, { 0, 1, 0 } } } };
  for (const auto& points : functions)
  {
    for (const auto& [scalars, lengths] : Product(List(2, 3, 20), List(1, 2, 3, 9)))
    {
      PreIntegrationTable table;
      table.Build(Intervals(points), 1e3, scalars, lengths);
      EXPECT_LE(table.GetNumberOfLengths(), lengths);
      EXPECT_EQ(
        table.GetValues().size(), std::size_t(4) * scalars * scalars * table.GetNumberOfLengths());
      for (const float value : table.GetValues())
      {
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
      }
    }
  }
}

// The optical depth of the longest segment is beyond the range of double.
TEST(PreIntegration, EndlessSegmentsAreOpaque)
{
  const std::vector<TransferFunctionInterval> function =
    Intervals({ { -1.0, 1e30, { 1, 0, 0 } }, { 1.0, 1e30, { 0, 1, 0 } } });
  PreIntegrationTable table;
  table.Build(function, std::numeric_limits<double>::max(), 3, 4);
  ASSERT_EQ(table.GetNumberOfLengths(), 4);
  // The colour at the front is all that the longest segments show.
  const std::size_t longest = 4 * 9 * 3;
  for (const auto& [front, back] : Product(3, 3))
  {
    const float* value = &table.GetValues()[longest + 4 * (3 * back + front)];
    EXPECT_NEAR(value[0], 1.0 - 0.5 * front, 1e-5) << front << " " << back;
    EXPECT_NEAR(value[1], 0.5 * front, 1e-5) << front << " " << back;
  }
}

// Between two points no attenuation is larger than at both, also where these are limited.
TEST(PreIntegration, LimitedAttenuationsGrowToTheirLimit)
{
  const auto function = Intervals({ { -4.0, 4.0, { 1, 0, 0 } }, { 1e9, 1e308, { 0, 1, 0 } } });
  ASSERT_EQ(function.size(), 3u);
  const TransferFunctionInterval& ramp = function[1];
  const double limit = function[2].Attenuation;
  EXPECT_NEAR(
    (ramp.Attenuation + (double{ ramp.Upper } - ramp.Lower) * ramp.AttenuationSlope) / limit, 1.0,
    1e-6);
}

// Where attenuation is 14 orders of magnitude smaller than elsewhere, colours are not lost in
// differences of integrals.
TEST(PreIntegration, FaintRangesKeepTheirColor)
{
  const glm::vec3 faint(0.25f, 0.5f, 0.75f);
  PreIntegrationTable table;
  table.Build(Intervals({ { -1.0, 1e12, { 1, 0, 0 } }, { -0.5, 1e12, { 1, 0, 0 } },
                { -0.5, 0.01, glm::dvec3(faint) }, { 1.0, 0.01, glm::dvec3(faint) } }),
    1.0, 9, 1);
  ASSERT_EQ(table.GetNumberOfLengths(), 1);
  for (const auto& [back, front] : Product(Numbers(3, 9), Numbers(3, 9)))
  {
    const float* entry = &table.GetValues()[4 * static_cast<std::size_t>(9 * back + front)];
    for (int channel = 0; channel < 3; ++channel)
    {
      EXPECT_NEAR(entry[channel], faint[channel], 1e-6) << front << " to " << back;
    }
  }
}

// A ramp as narrow as floats allow may change its width when the range of scalars is mapped to
// [-1, 1]; its colours stay between those of its ends.
TEST(PreIntegration, NarrowRampsKeepTheirEnds)
{
  const double last = std::nextafter(1.0f, 0.0f);
  const auto function =
    Intervals({ { last, 1.0, glm::dvec3(0.0) }, { 1.0, 2.0, glm::dvec3(1.0) } });
  for (double lowest = -1.0; lowest < 0.7; lowest += 0.01)
  {
    PreIntegrationTable table;
    table.Build(function, 1.0, 5, 1, SerialLoop, ScalarRange{ lowest, 1.0 });
    for (const float value : table.GetValues())
    {
      ASSERT_GE(value, 0.0f) << lowest;
      ASSERT_LE(value, 2.0f) << lowest;
    }
    const float* darkest = table.GetValues().data();
    const float* brightest = darkest + table.GetValues().size() - 4;
    ASSERT_EQ(darkest[0], 0.0f) << lowest;
    ASSERT_EQ(brightest[0], 1.0f) << lowest;
  }
}

TEST(PreIntegration, DoesNotDependOnTheThreads)
{
  const RangeLoop two = [](std::size_t count, const RangeBody& body)
  {
    std::thread half([&] { body(count / 2, count); });
    body(0, count / 2);
    half.join();
  };
  PreIntegrationTable serial;
  PreIntegrationTable parallel;
  serial.Build(Ramps(), 3.0, 40, 9);
  parallel.Build(Ramps(), 3.0, 40, 9, two);
  EXPECT_EQ(serial.GetValues(), parallel.GetValues());
}

TEST(PreIntegration, LongestEdge)
{
  TetrahedralMesh mesh;
  EXPECT_EQ(mesh.GetLongestEdge(), 0.0);
  const MeshArrays arrays = KuhnGrid(2); // 2^3 cubes, each split along a diagonal
  mesh.Build(arrays.View());
  // The radius of a grid is half its diagonal, which is that of one of the cubes.
  EXPECT_NEAR(mesh.GetLongestEdge(), 1.0, 1e-8);
}
