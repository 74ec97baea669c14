// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketOptics.h"

namespace meniscus
{

/**
 * Colour over opacity and mean attenuation of a segment between two positions in [-1, 1], by linear
 * interpolation in the table's scalars and in the index of its length.
 */
void LookUpSegment(
  const PacketSegmentTable& table, float from, float to, float length, float (&mean)[4]);

}
