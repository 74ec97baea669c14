// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RayCastNative_h
#define RayCastNative_h

#include "RayStatistics.h"
#include "Volume/RayWalk.h"

#include <vector>

namespace meniscus
{

/**
 * Casts the rays of an image on the CPU, rows in parallel by vtkSMPTools. The image does not depend
 * on the number of threads.
 * @param opaqueDepth  window depths in [0, 1], one per pixel, rows from below.
 * @param image        premultiplied RGBA per pixel; resized.
 */
RayStatistics CastRaysNative(const RayCastScene& scene, int width, int height,
  const std::vector<float>& opaqueDepth, std::vector<float>& image);

}

#endif
