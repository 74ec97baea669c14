// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Integral/IntegralView.h"

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

}
