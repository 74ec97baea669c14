// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Benchmarks_Refraction_Pool_h
#define meniscus_Benchmarks_Refraction_Pool_h

#include <string>
#include <vector>

namespace meniscus
{
namespace benchmark
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

/**
 * Percentage of the water's pixels that differ by more than 8/255 from rays through the exact
 * waves, and the time of an image: by the pass, and by an Embree tracer with the same textures,
 * Fresnel, sky and attenuation.
 */
struct PoolPictures
{
  double PassPercent = 0.0;
  double PassMs = 0.0;
  double TracedPercent = 0.0;
  double TracedMs = 0.0;
  bool HasTraced = false; ///< built with Embree
};
PoolPictures ComparePool();

} // namespace benchmark
} // namespace meniscus

#endif
