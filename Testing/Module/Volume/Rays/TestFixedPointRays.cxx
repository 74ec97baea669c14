// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of vertices about slanted rays, compared with the same in extended precision.
#include "TestBasics.h"
#include "Volume/Rays/ExactEdgeTest.h"
#include "Volume/Rays/FixedPointRays.h"

using namespace meniscus;

namespace
{

/** A frame of rays with slopes of up to 1/2. */
RayFrame MakeSlantedFrame(double smallestCell)
{
  RayFrame frame;
  frame.RowX = { 1.0, 0.0, 0.0 };
  frame.RowY = { 0.0, 1.0, 0.0 };
  frame.RowDepth = { 0.0, 0.0, 1.0 };
  frame.Slope.Base = { 0.5, -0.5 };
  frame.NearDepth = -1.0;
  frame.SmallestCell = smallestCell;
  return frame;
}

/** Largest errors of the coordinates of vertices next to rays. */
struct CoordinateErrors
{
  /** In grid units. */
  double Largest = 0.0;
  /** Errors beyond 2^-23 of the coordinate. */
  double BeyondRelative = 0.0;
};

/** @param distance largest distance of a vertex from the ray, in grid units. */
CoordinateErrors MeasureErrors(const FixedPointRays& rays, double distance)
{
  using Test = ExactEdgeTest<void>;
  std::mt19937 random(7);
  const auto uniform = [&random]() { return 2.0 * (random() / 4294967295.0) - 1.0; };
  CoordinateErrors errors;
  for (int trial = 0; trial < 20000; ++trial)
  {
    const glm::dvec2 slope(0.5 * uniform(), 0.5 * uniform());
    const glm::dvec2 origin(0.3 * uniform(), 0.3 * uniform());
    const PacketRay ray = rays.RayAlong(origin, slope);
    PacketVertex vertex{};
    vertex.Place[2] = static_cast<std::int32_t>(0.9 * uniform() * FixedPointRays::GridPerDepth);
    long double exact[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      const double atDepthZero = origin[axis] / rays.GetGridUnit();
      const double perDepth = slope[axis] / (rays.GetGridUnit() * FixedPointRays::GridPerDepth);
      const long double met = atDepthZero + static_cast<long double>(perDepth) * vertex.Place[2];
      vertex.Place[axis] =
        static_cast<std::int32_t>(std::llrint(static_cast<double>(met) + distance * uniform()));
      exact[axis] = vertex.Place[axis] - met;
    }
    const auto corner = Test::AboutRay(vertex, 0, ray, rays.GetPivot(), rays.AreFine());
    const float found[2] = { corner.U, corner.V };
    for (int axis = 0; axis < 2; ++axis)
    {
      const double error = static_cast<double>(std::fabs(found[axis] - exact[axis]));
      errors.Largest = std::max(errors.Largest, error);
      errors.BeyondRelative = std::max(errors.BeyondRelative,
        error - std::ldexp(static_cast<double>(std::fabs(exact[axis])), -23));
    }
  }
  return errors;
}

}

TEST(FixedPointRays, FineCoordinatesArePreciseRelativeToTheDistanceFromTheRay)
{
  const FixedPointRays rays(MakeSlantedFrame(1e-5), 2, 2, -1.0, 1.0);
  ASSERT_TRUE(rays.AreFine());
  // Fractions are truncated by 2^-16; rests of slopes below 2^-40 are left out, which is 2^-9 over
  // 2^31 grid units of depth; numbers below 2^8 are rounded five times by 2^-17.
  const double rounding = std::ldexp(1.0, -16) + std::ldexp(1.0, -9) + std::ldexp(5.0, -17);
  for (const double distance : { 10.0, 1e5 })
  {
    EXPECT_LE(MeasureErrors(rays, distance).BeyondRelative, rounding) << distance;
  }
}

TEST(FixedPointRays, OtherCoordinatesAreWithinTheRoundingOfRays)
{
  const FixedPointRays rays(MakeSlantedFrame(1.0), 2, 2, -1.0, 1.0);
  ASSERT_FALSE(rays.AreFine());
  const CoordinateErrors errors = MeasureErrors(rays, 1e5);
  EXPECT_LE(errors.Largest, FixedPointRays::RoundingOfRay);
  // These rays are not fine for a reason.
  EXPECT_GT(errors.Largest, 30.0);
}

TEST(FixedPointRays, AreFineWherePixelsAreCloseOrCellsSmall)
{
  const double unit = FixedPointRays(MakeSlantedFrame(1.0), 2, 2).GetGridUnit();
  const auto areFine = [unit](double spacing, double smallestCell)
  {
    return FixedPointRays(MakeSlantedFrame(smallestCell * unit), 2, 2, -1.0, spacing * unit)
      .AreFine();
  };
  EXPECT_FALSE(areFine(33000.0, 263000.0));
  EXPECT_TRUE(areFine(32000.0, 263000.0));
  EXPECT_TRUE(areFine(33000.0, 262000.0));
}
