// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/Kernels/KeptValues.h"

#include "Simd/SimdPortable.h"
#include "Volume/Packet/Models/IntensityProjectionModel.h"

#include <algorithm>

namespace meniscus
{
namespace
{

/** True if the mode keeps colour and transmittance; otherwise it keeps a number and a length. */
bool HidesWhatIsBehind(PacketBlending blending)
{
  return blending == PacketBlending::Composite || blending == PacketBlending::Isosurfaces;
}

}

//------------------------------------------------------------------------------
void ClearValues(PacketBlending blending, float (&values)[4])
{
  std::fill(values, values + 3, 0.0f);
  values[3] = HidesWhatIsBehind(blending) ? 1.0f : 0.0f;
}

//------------------------------------------------------------------------------
void JoinValues(PacketBlending blending, const float (&behind)[4], float (&values)[4])
{
  if (HidesWhatIsBehind(blending))
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      values[channel] += values[3] * behind[channel];
    }
    values[3] *= behind[3];
    return;
  }
  if (!(behind[1] > 0.0f))
  {
    return;
  }
  const bool sums = blending == PacketBlending::Average || blending == PacketBlending::Additive;
  if (sums || !(values[1] > 0.0f))
  {
    values[0] = values[1] > 0.0f ? values[0] + behind[0] : behind[0];
  }
  else
  {
    values[0] = blending == PacketBlending::Maximum ? std::max(values[0], behind[0])
                                                    : std::min(values[0], behind[0]);
  }
  values[1] += behind[1];
}

//------------------------------------------------------------------------------
void FinishValues(const PacketJob& job, const float (&values)[4], float (&color)[4])
{
  if (HidesWhatIsBehind(job.Blending))
  {
    FinishBlended<SimdPortable>(values, color);
    return;
  }
  IntensityProjectionModel<SimdPortable>::Finish(job, { values[0], values[1] }, color);
}

}
