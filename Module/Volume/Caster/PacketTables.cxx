// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/PacketTables.h"

namespace meniscus
{

//------------------------------------------------------------------------------
std::vector<PacketInterval> PackIntervals(const std::vector<TransferFunctionInterval>& intervals)
{
  std::vector<PacketInterval> packed;
  packed.reserve(intervals.size());
  for (const TransferFunctionInterval& interval : intervals)
  {
    const glm::vec3& color = interval.Color;
    const glm::vec3& slope = interval.ColorSlope;
    packed.push_back(
      { interval.Lower, interval.Upper, interval.Attenuation, interval.AttenuationSlope,
        { color.r, color.g, color.b, 0.0f }, { slope.r, slope.g, slope.b, 0.0f } });
  }
  return packed;
}

}
