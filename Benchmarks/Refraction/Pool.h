// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Pool_h
#define meniscus_Pool_h

#include <string>
#include <vector>

namespace meniscus
{
namespace benchmark
{

/**
 * A frame of vtkRefractionPass at 512 x 512 with Fresnel, a sky and attenuation, everything
 * recomputed: waves of 512 facets that move over textured walls of 1,445 vertices.
 */
struct PassFrames
{
  std::string Mode;
  double PerSecond = 0.0;
  double CpuMs = 0.0;
};
std::vector<PassFrames> measurePass();

/**
 * Pixels of the water that differ by more than 8/255 from rays through the exact waves, in
 * percent, and the time of a picture: the pass, and an Embree tracer with the same textures,
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
PoolPictures comparePool();

} // namespace benchmark
} // namespace meniscus

#endif
