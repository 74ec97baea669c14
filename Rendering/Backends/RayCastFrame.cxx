// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/RayCastFrame.h"

#include <tuple>

namespace meniscus
{

//------------------------------------------------------------------------------
bool HaveSameImage(const RayCastFrame& a, const RayCastFrame& b)
{
  const auto members = [](const RayCastFrame& frame)
  {
    const RayCastRefraction& refracting = frame.Refracting;
    return std::tie(frame.EarlyTerminationOpacity, frame.MaximumTableSize, frame.SettingsTime,
      frame.Output.ImageSize[0], frame.Output.ImageSize[1], frame.Output.RaysAcross,
      frame.Output.Interpolating, refracting.Part, refracting.Wanted, refracting.Met,
      refracting.Center, refracting.EyeDepth);
  };
  // Rays through interfaces begin at the near plane, wherever it is.
  const bool areStraight = !a.Refracting.Wanted && a.Refracting.Part == MembranePart::Whole;
  return members(a) == members(b) && a.Optics == b.Optics &&
    (a.Rays == b.Rays || (areStraight && DifferInClippingRange(a.Rays, b.Rays)));
}

}
