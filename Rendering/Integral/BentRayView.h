// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Common/Statistics.h"
#include "Rendering/Integral/IntegralView.h"
#include "Volume/Graded/GradedRayWalk.h"

#include <vector>

namespace meniscus
{

/** Share of the progress that rays take after the medium; the rest is that of the images. */
constexpr double ShareOfRays = 0.6;

/** Rays of an image before a medium bends them. */
struct BentRayView
{
  /** Image of parallel rays. */
  ParallelRectangle Rectangle;
  IntegralView Rays;
};

/** Statistics of the bent rays of an image, which `get` returns, followed by the owner's own. */
template <typename Owner>
std::vector<Statistic<Owner>> ListBentRays(
  GradedRayStatistics& (*get)(Owner& owner), const std::vector<Statistic<Owner>>& own)
{
  using Rays = GradedRayStatistics;
  return JoinStatistics<Owner, Rays>(
    {
      { "NumberOfRays", "rays of the last image that met the mesh",
        [](Rays& rays) { return double(rays.Rays); } },
      { "NumberOfTraversalSteps", "cells that the rays of the last image crossed",
        [](Rays& rays) { return double(rays.Steps); } },
      { "NumberOfStoppedRays", "rays of the last image that stayed in the mesh and were stopped",
        [](Rays& rays) { return double(rays.Trapped); } },
      { "NumberOfRaysStoppedInFolds",
        "stopped rays of the last image that have passed inverted cells, where light goes back",
        [](Rays& rays) { return double(rays.TrappedInFolds); } },
      { "NumberOfLostRays",
        "rays of the last image without a way out of a cell, caused by numbers beyond the range of "
        "doubles",
        [](Rays& rays) { return double(rays.Lost); } },
    },
    get, own);
}

}
