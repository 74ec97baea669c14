// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Clipping planes of the frame of the rays, whatever the ratio of their distances.
#include "TestBasics.h"
#include "Volume/Rays/RayFrame.h"

using namespace meniscus::test;
using namespace meniscus;

namespace
{

constexpr double Distance = 5.0;
constexpr double Radius = 2.0;

/** A camera at a distance from the mesh's centre, with a projection as VTK computes it. */
RayFrame FrameBetween(double nearest, double farthest, bool parallel)
{
  const double width = farthest - nearest;
  RayFrameInput input;
  input.WorldToView[3][2] = -Distance;
  input.Radius = Radius;
  input.ImageSize = glm::dvec2(100.0);
  glm::dmat4& clip = input.ViewToClip;
  clip[2][2] = (parallel ? -2.0 : -(farthest + nearest)) / width;
  clip[3][2] = (parallel ? -(farthest + nearest) : -2.0 * nearest * farthest) / width;
  clip[2][3] = parallel ? 0.0 : -1.0;
  clip[3][3] = parallel ? 1.0 : 0.0;
  RayFrame frame;
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Ok);
  return frame;
}

double DepthOf(double distance)
{
  return (distance - Distance) / Radius;
}

}

TEST(ClippingRange, DepthsOfTheClippingPlanes)
{
  for (const auto& [parallel, nearest, farthest] :
    Product(List(false, true), List(1.0e-300, 1.0e-30, 1.0e-12, 1.0e-7, 0.1, 4.5),
      List(5.5, 100.0, 1.0e+9, 1.0e+30, 1.0e+300)))
  {
    const RayFrame frame = FrameBetween(nearest, farthest, parallel);
    const std::string what =
      std::to_string(std::log10(nearest)) + " to " + std::to_string(std::log10(farthest));
    // The matrix has the number 1 plus or minus a share of the distances: four roundings of it.
    const double lost = 4.0 * 2.2e-16;
    const double share = nearest / farthest;
    // In a parallel projection the planes' distance is the unit; in perspective, the reciprocal
    // of the far plane's distance is known in units of that of the near plane.
    const double outermost = parallel ? lost * farthest : lost * nearest;
    EXPECT_LE(frame.NearDepth, DepthOf(nearest) + 1.0e-15) << what;
    EXPECT_GE(frame.NearDepth, DepthOf(nearest - outermost) - 1.0e-15) << what;
    EXPECT_EQ(frame.DepthAt(-1.0), frame.NearDepth) << what;
    EXPECT_EQ(frame.DepthAt(1.0), frame.FarDepth) << what;
    EXPECT_GE(frame.FarDepth, std::min(DepthOf(farthest), RayFrame::FarthestDepth)) << what;
    const double widest = parallel ? farthest * (1.0 + lost)
      : share > lost               ? nearest / (share - lost)
                                   : 1.0e+301;
    EXPECT_LE(frame.FarDepth, std::min(DepthOf(widest), RayFrame::FarthestDepth)) << what;
  }
}

TEST(ClippingRange, DepthsBetweenTheClippingPlanes)
{
  for (const auto& [nearest, farthest] :
    Product(List(1.0e-30, 1.0e-12, 1.0e-3), List(10.0, 1.0e+9, 1.0e+30)))
  {
    const RayFrame frame = FrameBetween(nearest, farthest, false);
    for (const double rest : { 1.0, 0.75, 0.5, 0.0009765625, std::ldexp(1.0, -24) })
    {
      const double window = 1.0 - rest; // exact
      // The reciprocal of the distance is linear in the window depth.
      const double distance = 1.0 / (rest / nearest + window / farthest);
      // An entry of the matrix is 1 plus a ratio of distances, which is rounded as 1 is.
      const double error = 4.0 * 2.2e-16 * (1.0 + distance / rest);
      EXPECT_NEAR(frame.DepthAt(2.0 * window - 1.0), DepthOf(distance), error) << window;
    }
  }
}
