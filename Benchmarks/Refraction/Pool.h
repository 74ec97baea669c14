// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace meniscus::benchmark
{

/**
 * A frame of vtkRefractionPass at 512 x 512 with Fresnel, a sky and attenuation, completely
 * recomputed: 512 facets of moving waves above textured walls of 1,445 vertices.
 */
struct PassFrames
{
  std::string Mode;
  double PerSecond = 0.0;
  double CpuMs = 0.0;
};
std::vector<PassFrames> MeasurePass();

/** One way to draw the pool with textures, Fresnel, a sky and attenuation, with new waves. */
struct PoolFigures
{
  std::string SetUp;
  double Percent = 0.0; ///< pixels of the water off by more than 8/255, against the exact waves
  double Ms = 0.0;      ///< time of a frame
  double CpuMs = 0.0;   ///< processor time of a frame
};

/**
 * The pool by the pass and by an Embree tracer: with a fine membrane and the default tolerance, and
 * each with the cheapest settings whose error is below `AcceptedPercent`.
 */
struct PoolPictures
{
  static constexpr double AcceptedPercent = 0.1;

  PoolFigures Pass;
  PoolFigures Traced;
  PoolFigures EqualPass; ///< cheapest settings with at most the error of `Traced`
  PoolFigures CoarsePass;
  PoolFigures CoarseTraced;
  bool HasTraced = false; ///< built with Embree
};
PoolPictures ComparePool();

} // namespace meniscus::benchmark
