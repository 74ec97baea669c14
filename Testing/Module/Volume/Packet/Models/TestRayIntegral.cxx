// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelMeshes.h"
#include "Simd/SimdPortable.h"
#include "TestBasics.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/CompositeModel.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Bound of the fit of psi (3e-7 per unit of optical depth, damped) and of float sums. */
constexpr double Tolerance = 1e-6;

/** The integral by many midpoint steps in double precision: red and alpha. */
glm::dvec2 Reference(double t0, double t1, double c0, double c1, double length)
{
  const int steps = 400000;
  double color = 0.0;
  double depth = 0.0;
  const double h = length / steps;
  for (int i = 0; i < steps; ++i)
  {
    const double x = (i + 0.5) / steps;
    const double attenuation = t0 + x * (t1 - t0);
    color += (c0 + x * (c1 - c0)) * attenuation * std::exp(-depth - 0.5 * attenuation * h) * h;
    depth += attenuation * h;
  }
  return { color, 1.0 - std::exp(-depth) };
}

/** The integral of one ray: a lane of a packet whose other lanes are idle. */
class RayIntegral
{
public:
  RayIntegral(const std::vector<TransferFunctionInterval>& intervals, float termination)
    : Intervals(PackIntervals(intervals))
    , Packet(JobOf(this->Intervals, termination))
  {
  }

  void AddSegment(float from, float to, float length)
  {
    SimdPortable::Mask pending = this->Packet.Begin(SimdPortable::FromBits(1u << Lane),
      SimdPortable::Splat(from), SimdPortable::Splat(to), SimdPortable::Splat(length), nullptr);
    while (SimdPortable::Bits(pending) != 0)
    {
      pending = this->Packet.Advance(pending);
    }
  }
  glm::vec3 GetColor() const { return { this->Value(0), this->Value(1), this->Value(2) }; }
  float GetTransmittance() const { return this->Value(3); }

private:
  static PacketJob JobOf(const std::vector<PacketInterval>& intervals, float termination)
  {
    PacketJob job = {};
    job.Intervals = intervals.data();
    job.NumberOfIntervals = static_cast<std::int32_t>(intervals.size());
    job.TerminationTransmittance = termination;
    return job;
  }
  float Value(int k) const
  {
    float values[4][SimdPortable::Width];
    this->Packet.Store(values);
    return values[k][Lane];
  }

  static constexpr int Lane = 1;
  std::vector<PacketInterval> Intervals;
  CompositeModel<SimdPortable> Packet;
};

std::vector<TransferFunctionInterval> Ramp(double t0, double t1, double c0, double c1)
{
  return BuildIntervals(
    { { -1.0, t0, glm::dvec3(c0) }, { 1.0, t1, glm::dvec3(c1) } }, ScalarNormalization());
}

}

TEST(RayIntegral, ConstantAttenuationIsExponential)
{
  for (const double depth : { 1e-6, 1e-3, 0.1, 0.99, 1.01, 3.0, 12.0, 80.0 })
  {
    const auto intervals = ConstantFunction(depth);
    RayIntegral integral(intervals, 0.0f);
    integral.AddSegment(0.25f, 0.5f, 1.0f);
    EXPECT_NEAR(1.0 - integral.GetTransmittance(), -std::expm1(-depth), 1e-6) << depth;
    EXPECT_NEAR(integral.GetColor().g, -std::expm1(-depth), 1e-6) << depth;
  }
}

TEST(RayIntegral, LinearAttenuationAndColor)
{
  const double depths[4] = { 0.02, 0.8, 5.0, 40.0 };
  for (const double t0 : depths)
  {
    for (const double t1 : { 0.0, 0.3, 20.0 })
    {
      const auto intervals = Ramp(t0, t1, 0.1, 0.9);
      RayIntegral integral(intervals, 0.0f);
      integral.AddSegment(-1.0f, 1.0f, 1.5f);
      const glm::dvec2 truth = Reference(t0, t1, 0.1, 0.9, 1.5);
      EXPECT_NEAR(integral.GetColor().r, truth.x, Tolerance) << t0 << " " << t1;
      EXPECT_NEAR(1.0 - integral.GetTransmittance(), truth.y, Tolerance) << t0 << " " << t1;
    }
  }
}

TEST(RayIntegral, SplitsAtEveryPointInBothDirections)
{
  // A peak narrower than the segment: its optical depth is the area under the peak.
  const auto intervals =
    BuildIntervals({ { 0.40, 0.0, glm::dvec3(1.0) }, { 0.41, 50.0, glm::dvec3(1.0) },
                     { 0.42, 0.0, glm::dvec3(1.0) } },
      ScalarNormalization());
  for (const bool upward : { true, false })
  {
    RayIntegral integral(intervals, 0.0f);
    integral.AddSegment(upward ? -1.0f : 1.0f, upward ? 1.0f : -1.0f, 4.0f);
    // Scalars change by 2 over a length of 4: the peak is 0.04 long, its mean attenuation 25.
    EXPECT_NEAR(1.0 - integral.GetTransmittance(), 1.0 - std::exp(-1.0), 2e-6);
  }
}

TEST(RayIntegral, JumpsAndValuesOutside)
{
  const auto intervals =
    BuildIntervals({ { 0.0, 0.0, glm::dvec3(0.0) }, { 0.0, 2.0, glm::dvec3(0.5) },
                     { 0.5, 2.0, glm::dvec3(0.5) }, { 0.5, 0.0, glm::dvec3(0.0) } },
      ScalarNormalization());
  RayIntegral integral(intervals, 0.0f);
  integral.AddSegment(-1.0f, 1.0f, 2.0f); // visible over a quarter of it
  EXPECT_NEAR(1.0 - integral.GetTransmittance(), 1.0 - std::exp(-1.0), 1e-6);
  EXPECT_NEAR(integral.GetColor().b, 0.5 * (1.0 - std::exp(-1.0)), 1e-6);
}

TEST(RayIntegral, PiecesOfASegmentAddUp)
{
  const auto intervals = Ramp(0.1, 3.0, 0.0, 1.0);
  RayIntegral whole(intervals, 0.0f);
  whole.AddSegment(-0.8f, 0.9f, 2.0f);
  RayIntegral parts(intervals, 0.0f);
  const int n = 50;
  for (int i = 0; i < n; ++i)
  {
    parts.AddSegment(-0.8f + 1.7f * i / n, -0.8f + 1.7f * (i + 1) / n, 2.0f / n);
  }
  EXPECT_NEAR(whole.GetColor().r, parts.GetColor().r, Tolerance);
  EXPECT_NEAR(whole.GetTransmittance(), parts.GetTransmittance(), Tolerance);
}

TEST(RayIntegral, DegenerateInputAddsNothingAndEnds)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto intervals = Ramp(0.0, 1e38, 0.0, 1.0);
  RayIntegral integral(intervals, 0.0f);
  integral.AddSegment(nan, 0.0f, 1.0f);
  integral.AddSegment(0.0f, nan, 1.0f);
  integral.AddSegment(0.0f, infinity, 1.0f);
  integral.AddSegment(0.0f, 1.0f, 0.0f);
  integral.AddSegment(0.0f, 1.0f, nan);
  EXPECT_EQ(integral.GetTransmittance(), 1.0f);
  integral.AddSegment(-1.0f, 1.0f, 1.0f); // attenuation of 1e38: opaque at once
  EXPECT_LT(integral.GetTransmittance(), 1e-6f);
  EXPECT_TRUE(std::isfinite(integral.GetColor().r));
}

TEST(TransferFunction, IntervalsCoverEveryScalarWithoutGaps)
{
  const auto normalization = NormalizeRange(100.0, 300.0);
  const auto intervals =
    BuildIntervals({ { 150.0, 1.0, glm::dvec3(0.1) }, { 200.0, 3.0, glm::dvec3(0.2) },
                     { 250.0, 0.0, glm::dvec3(0.9) } },
      normalization);
  ASSERT_EQ(intervals.size(), 4u);
  EXPECT_LT(intervals.front().Lower, -1e30f);
  EXPECT_GT(intervals.back().Upper, 1e30f);
  for (std::size_t i = 0; i + 1 < intervals.size(); ++i)
  {
    EXPECT_EQ(intervals[i].Upper, intervals[i + 1].Lower);
  }
  EXPECT_FLOAT_EQ(intervals[1].Lower, -0.5f);
  EXPECT_FLOAT_EQ(intervals[1].AttenuationSlope, 4.0f);
  EXPECT_FLOAT_EQ(intervals[0].Attenuation, 1.0f);
}

TEST(TransferFunction, EmptyConstantAndHugeRanges)
{
  const auto nothing = BuildIntervals({}, ScalarNormalization());
  ASSERT_EQ(nothing.size(), 1u);
  EXPECT_EQ(nothing[0].Attenuation, 0.0f);
  EXPECT_EQ(NormalizeRange(5.0, 5.0).Scale, 1.0);
  const double huge = 1e308;
  const auto normalization = NormalizeRange(-huge, huge);
  // The scale is a denormal number, which has fewer digits.
  EXPECT_NEAR((huge - normalization.Offset) * normalization.Scale, 1.0, 1e-14);
}
