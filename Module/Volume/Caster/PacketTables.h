// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_PacketTables_h
#define meniscus_Volume_Caster_PacketTables_h

#include "Volume/Optics/TransferFunction.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <vector>

namespace meniscus
{

/** What the packets read, in their layout; see the builders below. */
struct PacketTables
{
  /** As the rays of an image see them. */
  std::vector<PacketVertex> Vertices;
  std::vector<PacketInterval> Intervals;
  std::vector<PacketSurface> Surfaces;
  /** Of components that have functions of their own; of the lengths of gradients. */
  std::vector<std::vector<PacketInterval>> OtherIntervals;
  std::vector<PacketInterval> GradientIntervals;
};

/** Intervals of a transfer function in the layout of the packets. */
std::vector<PacketInterval> PackIntervals(const std::vector<TransferFunctionInterval>& intervals);

}

#endif
