// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Events of segments: closed forms, splits that must not matter, and degenerate segments.
#include "TestBasics.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Packet/Models/RayEventSegments.h"

using namespace meniscus;

namespace
{

/** A ray through segments of one length per depth. */
class EventRay
{
public:
  explicit EventRay(const std::vector<TransferFunctionPoint>& points, double opacity = 0.5)
    : Intervals(PackIntervals(BuildIntervals(points, ScalarNormalization())))
  {
    this->Job.Intervals = this->Intervals.data();
    this->Job.NumberOfIntervals = static_cast<std::int32_t>(this->Intervals.size());
    this->Job.EventLimits.Opacity = opacity;
    this->Job.EventLimits.OpticalDepth = -std::log1p(-opacity);
    this->Job.EventLimits.LargestAttenuation = BoundAttenuation(this->Job);
  }
  bool Add(double begin, double end, double from, double to)
  {
    const RayEventSegment segment{ from, to, end - begin, begin, end, this->Cells++,
      { nullptr, nullptr }, { nullptr, nullptr } };
    return AddToEvents(this->Job, segment, this->State);
  }
  const RayEvent& At(RayEventKind kind) const { return this->State.Events[kind]; }

  std::vector<PacketInterval> Intervals;
  std::vector<PacketSurface> Surfaces;
  PacketJob Job{};
  RayEventState State = EmptyRayEvents();
  std::int32_t Cells = 0;
};

TransferFunctionPoint Point(double scalar, double attenuation)
{
  return { scalar, attenuation, glm::dvec3(1.0) };
}

/** Attenuation 2 (s + 1), from 0 at the scalar -1. */
std::vector<TransferFunctionPoint> Ramp()
{
  return { Point(-1.0, 0.0), Point(1.0, 4.0) };
}

}

//------------------------------------------------------------------------------
/** The scalar rises from -1 to 1 over the length 2: attenuation 2 t, optical depth t t. */
TEST(RayEvents, LinearAttenuation)
{
  for (const int parts : { 1, 2, 7, 100 })
  {
    EventRay ray(Ramp());
    for (int i = 0; i < parts; ++i)
    {
      const double begin = 2.0 * i / parts;
      const double end = 2.0 * (i + 1) / parts;
      ray.Add(begin, end, begin - 1.0, end - 1.0);
    }
    // Intervals are floats: 1e-7 of the attenuation.
    EXPECT_NEAR(ray.At(FirstVisibleEvent).Depth, 0.0, 1.0e-7) << parts;
    EXPECT_EQ(ray.At(FirstVisibleEvent).Cell, 0);
    EXPECT_NEAR(ray.At(OpacityReachedEvent).Depth, std::sqrt(std::log(2.0)), 1.0e-7) << parts;
    // 2 t exp(-t t) is largest where 2 = 4 t t.
    const double peak = std::sqrt(0.5);
    EXPECT_NEAR(ray.At(LargestContributionEvent).Depth, peak, 1.0e-7) << parts;
    EXPECT_NEAR(ray.At(LargestContributionEvent).Scalar, peak - 1.0, 1.0e-7) << parts;
    EXPECT_EQ(ray.At(LargestContributionEvent).Cell, static_cast<int>(0.5 * parts * peak));
    EXPECT_NEAR(ray.State.Largest, std::sqrt(2.0) * std::exp(-0.5), 1.0e-6) << parts;
    EXPECT_NEAR(ray.State.OpticalDepth, 4.0, 1.0e-6) << parts;
  }
}

//------------------------------------------------------------------------------
/** Falling scalars, jumps of the function, and intervals that a segment only touches. */
TEST(RayEvents, FunctionWithWindows)
{
  const std::vector<TransferFunctionPoint> windows{ Point(-0.5, 0.0), Point(-0.5, 3.0),
    Point(-0.25, 3.0), Point(-0.25, 0.0), Point(0.25, 0.0), Point(0.25, 1.0), Point(0.5, 1.0),
    Point(0.5, 0.0) };
  EventRay down(windows, 0.3);
  EXPECT_TRUE(down.Add(0.0, 1.0, 1.0, 0.5));
  EXPECT_LT(down.At(FirstVisibleEvent).Cell, 0);
  down.Add(1.0, 4.0, 0.5, -1.0);
  EXPECT_NEAR(down.At(FirstVisibleEvent).Depth, 1.0, 1.0e-7);
  // The first window has an optical depth of 0.5: 1 - exp(-0.5) > 0.3.
  EXPECT_NEAR(down.At(OpacityReachedEvent).Depth, 1.0 - std::log(0.7), 1.0e-6);
  // 3 exp(-0.5) > 1 at the beginning of the second window.
  EXPECT_NEAR(down.At(LargestContributionEvent).Depth, 2.5, 1.0e-6);
  EXPECT_NEAR(down.State.OpticalDepth, 0.5 + 1.5, 1.0e-6);
  EventRay up(windows, 0.3);
  up.Add(0.0, 2.0, -1.0, 1.0);
  EXPECT_NEAR(up.At(FirstVisibleEvent).Depth, 0.5, 1.0e-7);
  EXPECT_NEAR(up.At(LargestContributionEvent).Depth, 0.5, 1.0e-7);
  // A constant scalar on the boundary of a window, and one inside it.
  EventRay flat(windows);
  flat.Add(0.0, 1.0, 0.3, 0.3);
  EXPECT_NEAR(flat.At(OpacityReachedEvent).Depth, std::log(2.0), 1.0e-6);
}

//------------------------------------------------------------------------------
/** Independent components add up; gradient opacity is a factor. */
TEST(RayEvents, ComponentsAndGradients)
{
  EventRay ray(Ramp());
  const auto second = PackIntervals(BuildIntervals({ Point(-1.0, 1.0), Point(1.0, 3.0) }, {}));
  ray.Job.Mixture = ComponentMixture::Independent;
  ray.Job.OtherIntervals[0] = second.data();
  ray.Job.NumberOfOtherIntervals[0] = static_cast<std::int32_t>(second.size());
  const float first[3] = { 1.0f, 0.0f, 0.0f };
  const float last[3] = { -1.0f, 0.0f, 0.0f };
  // Attenuation 2 t + 3 - t over the length 2.
  const RayEventSegment segment{ -1.0, 1.0, 2.0, 0.0, 2.0, 0, { first, last },
    { nullptr, nullptr } };
  AddToEvents(ray.Job, segment, ray.State);
  EXPECT_NEAR(
    ray.At(OpacityReachedEvent).Depth, -3.0 + std::sqrt(9.0 + 2.0 * std::log(2.0)), 1.0e-6);
  EXPECT_NEAR(ray.State.OpticalDepth, 8.0, 1.0e-6);

  EventRay lit({ Point(-1.0, 2.0), Point(1.0, 2.0) });
  const auto steep = PackIntervals(BuildIntervals({ Point(0.0, 0.0), Point(10.0, 1.0) }, {}));
  GradientShading medium{};
  medium.GradientToFrame[0][0] = medium.GradientToFrame[1][1] = medium.GradientToFrame[2][2] = 1.0f;
  medium.GradientMagnitude = 2.0f;
  medium.Opacity = steep.data();
  medium.NumberOfOpacityIntervals = static_cast<std::int32_t>(steep.size());
  lit.Job.Medium = &medium;
  EXPECT_NEAR(BoundAttenuation(lit.Job), 2.0, 1.0e-6);
  const float weak[3] = { 0.0f, 0.0f, 0.0f };
  const float strong[3] = { 3.0f, 0.0f, 4.0f };
  const RayEventSegment shaded{ 0.0, 0.0, 1.0, 0.0, 1.0, 0, { nullptr, nullptr },
    { weak, strong } };
  AddToEvents(lit.Job, shaded, lit.State);
  // The factor rises from 0 to 1: optical depth t t.
  EXPECT_NEAR(lit.State.OpticalDepth, 1.0, 1.0e-6);
  EXPECT_NEAR(lit.At(OpacityReachedEvent).Depth, std::sqrt(std::log(2.0)), 1.0e-6);
}

//------------------------------------------------------------------------------
TEST(RayEvents, Surfaces)
{
  EventRay ray({}, 0.6);
  ray.Job.Blending = BlendMode::Isosurfaces;
  ray.Surfaces = { { -0.5f, 0.0f, {} }, { 0.0f, 0.3f, {} }, { 0.5f, 0.8f, {} } };
  ray.Job.Surfaces = ray.Surfaces.data();
  ray.Job.NumberOfSurfaces = 3;
  EXPECT_TRUE(ray.Add(0.0, 1.0, -1.0, -0.5));
  // The surface without opacity is not seen.
  EXPECT_LT(ray.At(FirstVisibleEvent).Cell, 0);
  EXPECT_TRUE(ray.Add(1.0, 2.0, -0.5, 0.25));
  EXPECT_EQ(ray.At(FirstVisibleEvent).Surface, 1);
  EXPECT_NEAR(ray.At(FirstVisibleEvent).Depth, 1.0 + 0.5 / 0.75, 1.0e-12);
  EXPECT_LT(ray.At(OpacityReachedEvent).Cell, 0);
  // 0.7 * 0.8 more: nothing behind can contribute more than the rest.
  EXPECT_FALSE(ray.Add(2.0, 3.0, 0.25, 0.75));
  EXPECT_EQ(ray.At(OpacityReachedEvent).Surface, 2);
  EXPECT_EQ(ray.At(LargestContributionEvent).Surface, 2);
  EXPECT_EQ(ray.At(LargestContributionEvent).Cell, 2);
  EXPECT_EQ(ray.At(FirstVisibleEvent).Surface, 1);

  // A value that is passed between two segments is met where the second one begins, unless they
  // are apart.
  EventRay gap({}, 0.6);
  gap.Job = ray.Job;
  gap.Add(0.0, 1.0, -1.0, -0.25);
  EXPECT_TRUE(gap.Add(1.0, 2.0, 0.25, 0.25));
  EXPECT_EQ(gap.At(FirstVisibleEvent).Surface, 1);
  EXPECT_EQ(gap.At(FirstVisibleEvent).Depth, 1.0);
  gap.State = EmptyRayEvents();
  gap.Add(0.0, 1.0, -1.0, -0.25);
  gap.State.SurfacesBelow = -1;
  gap.Add(1.0, 2.0, 0.25, 0.25);
  EXPECT_LT(gap.At(FirstVisibleEvent).Cell, 0);
}

//------------------------------------------------------------------------------
TEST(RayEvents, ThresholdsAndExtremes)
{
  EventRay zero(Ramp(), 0.0);
  zero.Add(0.0, 2.0, -1.0, 1.0);
  EXPECT_EQ(zero.At(OpacityReachedEvent).Depth, zero.At(FirstVisibleEvent).Depth);
  EventRay one({ Point(-1.0, 1.0e18), Point(1.0, 1.0e18) }, 1.0);
  // Opaque at once: nothing is left, and the ray ends although the threshold is not reached.
  EXPECT_FALSE(one.Add(0.0, 2.0, 0.0, 0.0));
  EXPECT_LT(one.At(OpacityReachedEvent).Cell, 0);
  EXPECT_EQ(one.At(LargestContributionEvent).Depth, 0.0);
  EventRay dark({ Point(-1.0, 0.0), Point(1.0, 0.0) });
  EXPECT_TRUE(dark.Add(0.0, 2.0, -1.0, 1.0));
  EXPECT_LT(dark.At(FirstVisibleEvent).Cell, 0);
  for (const BlendMode mode : { BlendMode::MaximumIntensity, BlendMode::MinimumIntensity })
  {
    EventRay ray({});
    ray.Job.Blending = mode;
    ray.Add(0.0, 1.0, 0.1, 0.4);
    ray.Add(1.0, 2.0, 0.4, 0.2);
    ray.Add(2.0, 3.0, 0.1, 0.4);
    const bool isMaximum = mode == BlendMode::MaximumIntensity;
    for (const RayEvent& event : ray.State.Events)
    {
      EXPECT_EQ(event.Depth, isMaximum ? 1.0 : 0.0);
      EXPECT_EQ(event.Scalar, isMaximum ? 0.4 : 0.1);
      EXPECT_EQ(event.Cell, 0);
    }
  }
  EventRay average({});
  average.Job.Blending = BlendMode::AverageIntensity;
  EXPECT_FALSE(average.Add(3.0, 4.0, 0.1, 0.4));
  EXPECT_EQ(average.At(LargestContributionEvent).Depth, 3.0);
}
