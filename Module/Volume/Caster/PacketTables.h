// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/TransferFunction.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <vector>

namespace meniscus
{

/** Input tables of the packets, in their layout; see the builders below. */
struct PacketTables
{
  /** Vertices in the grid of an image's rays. */
  std::vector<PacketVertex> Vertices;
  std::vector<PacketInterval> Intervals;
  std::vector<PacketSurface> Surfaces;
  /**
   * Intervals of the other components that have functions of their own, and of gradient opacity.
   */
  std::vector<std::vector<PacketInterval>> OtherIntervals;
  std::vector<PacketInterval> GradientIntervals;
};

/** Converts intervals of a transfer function to the layout of the packets. */
std::vector<PacketInterval> PackIntervals(const std::vector<TransferFunctionInterval>& intervals);

}
