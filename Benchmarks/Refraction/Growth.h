// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractionOptions.h"

#include <cstddef>
#include <string>

namespace meniscus::benchmark
{

/**
 * Cost for a membrane with a given number of facets; processor seconds of one thread unless stated.
 */
struct GrowthFigures
{
  std::size_t Facets = 0;
  double FlatShape = 0.0;
  double FlatEye = 0.0;
  double FlatCoherent = 0.0;   ///< microseconds per vertex, grid order
  double FlatScattered = 0.0;  ///< the same, random order, solved along a curve
  double FlatBruteForce = 0.0; ///< the same, testing every facet
  double CurvedShape = 0.0;    ///< a new topology
  double CurvedDeform = 0.0;   ///< the same topology, other points
  double CurvedEye = 0.0;
  double CurvedOne = 0.0;       ///< microseconds per vertex, one image, grid order
  double CurvedScattered = 0.0; ///< the same, random order, solved along a curve
  double PointOrder = 0.0;      ///< microseconds per vertex to find the order along the curve
  double CurvedAll = 0.0; ///< the same, all images of an object's points, as the filter computes
                          ///< them
  double CurvedSearch =
    0.0;                  ///< all images of each point by itself: searched for, whatever is known
  double FlatError = 0.0; ///< mean distance between true points and the points that are drawn
  double CurvedError = 0.0;
};

/** Waves of `cells` x `cells` x 2 facets. */
GrowthFigures MeasureGrowth(int cells);

/**
 * Wall and processor seconds of CURVED for a new eye and for a deformed membrane, by number of
 * threads.
 */
struct ThreadedFigures
{
  std::size_t Facets = 0;
  double EyeWall = 0.0;
  double EyeCpu = 0.0;
  double DeformWall = 0.0;
  double DeformCpu = 0.0;
};
ThreadedFigures MeasureThreaded(int cells);

/**
 * Prints cost by facets and by vertices, and time against error; returns members of a JSON object.
 * Writes CSV and plot if requested; returns an empty string if one of them cannot be written.
 */
std::string RunGrowth(const RefractionOptions& options);

} // namespace meniscus::benchmark
