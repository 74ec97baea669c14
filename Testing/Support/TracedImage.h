// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PixelRays.h"
#include "VolumeScene.h"

namespace meniscus::test
{

/** Premultiplied colour of a ray; called from several threads at once. */
using TraceRay = std::function<std::array<double, 4>(const reference::Ray&)>;

struct TracedComparison
{
  double Largest = 0.0;    // over all pixels that are not excused
  double Rms = 0.0;        // over the visible ones of them
  std::size_t Visible = 0; // pixels whose exact result is not empty
  std::size_t Wrong = 0;   // error above the tolerance
  std::size_t Excused = 0; // further such pixels for which moving the ray explains the difference
  int WorstPixel[2] = { -1, -1 };
  std::array<double, 4> WorstImage{};
  std::array<double, 4> WorstTruth{};

  std::string GetText() const;
};

/**
 * Compares a float image with the exact result of each pixel's ray, on all processors. A pixel with
 * an error above the tolerance is excused if the exact result itself changes by at least half of
 * that when the ray moves sideways by `rounding`: at silhouettes, in front of steps.
 */
TracedComparison CompareToTrace(const FloatImage& image, const PixelRays& rays,
  const TraceRay& trace, double tolerance, double rounding);

} // namespace meniscus::test
