// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Integral_BentRayView_h
#define meniscus_Rendering_Integral_BentRayView_h

#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Integral/IntegralView.h"

namespace meniscus
{

/** Share of the progress that rays take after the medium; the rest is that of the images. */
constexpr double ShareOfRays = 0.6;

/** A medium that bends light, and the rays of an image before they are bent. */
struct BentRayView
{
  BentMedium Medium;
  /** Image of parallel rays. */
  ParallelRectangle Rectangle;
  IntegralView Rays;
};

}

#endif
