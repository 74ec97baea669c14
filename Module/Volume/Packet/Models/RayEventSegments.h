// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Data/RayEvents.h"

#include <cstdint>

namespace meniscus
{

/** Part of a ray within a cell, where all values are linear. */
struct RayEventSegment
{
  double From;
  double To;
  /** World length. */
  double Length;
  /** Depths of the ends in grid units from the pivot. */
  double StartDepth;
  double EndDepth;
  std::int32_t Cell;
  /** Three other components of the scalar at each end; null without a mixture. */
  const float* Components[2];
  /** Gradient at each end in normalised model coordinates; null without gradient opacity. */
  const float* Gradients[2];
};

/** State of a ray that has met nothing. */
RayEventState EmptyRayEvents();

/** Upper bound of the attenuation coefficient of the functions of a job. */
double BoundAttenuation(const PacketJob& job);

/**
 * Adds the events of a segment. Returns false if no further segment of the ray can change them.
 */
bool AddToEvents(const PacketJob& job, const RayEventSegment& segment, RayEventState& state);

}
