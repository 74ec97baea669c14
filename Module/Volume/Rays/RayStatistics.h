// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace meniscus
{

/** Sums over the rays of a frame. */
struct RayStatistics
{
  /** Number of cells crossed. */
  std::int64_t Steps = 0;
  /** Number of rays that entered the mesh, interpolated ones included. */
  std::int64_t Rays = 0;
  /** Number of rays whose walk did not end on the boundary. */
  std::int64_t Lost = 0;
  /** Number of rays, of each leg, that found parts of the mesh to overlap. */
  std::int64_t Overlaps = 0;
  /** Number of rays that entered the mesh, but were interpolated between others. */
  std::int64_t Interpolated = 0;
};

/** Sums over the rays of all parts of a frame. */
inline RayStatistics SumOf(const std::vector<RayStatistics>& parts)
{
  RayStatistics sum;
  for (const RayStatistics& part : parts)
  {
    sum.Steps += part.Steps;
    sum.Rays += part.Rays;
    sum.Lost += part.Lost;
    sum.Overlaps += part.Overlaps;
    sum.Interpolated += part.Interpolated;
  }
  return sum;
}

}
