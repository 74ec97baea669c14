// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/Kernels/KeptValues.h"

#include "Simd/SimdPortable.h"
#include "Volume/Packet/Models/BlendModeModels.h"

#include <algorithm>

namespace meniscus
{
namespace
{

void JoinColors(const float (&behind)[4], float (&values)[4])
{
  for (int channel = 0; channel < 3; ++channel)
  {
    values[channel] += values[3] * behind[channel];
  }
  values[3] *= behind[3];
}

float JoinNumbers(KeptResult kept, float front, float behind)
{
  switch (kept)
  {
    case KeptResult::Largest:
      return std::max(front, behind);
    case KeptResult::Smallest:
      return std::min(front, behind);
    default:
      return front + behind;
  }
}

template <class Model>
void FinishOf(const PacketJob& job, const float (&values)[4], float (&color)[4])
{
  float kept[Model::NumberOfValues];
  std::copy_n(values, Model::NumberOfValues, kept);
  Model::Finish(job, kept, color);
}

}

//------------------------------------------------------------------------------
void ClearValues(BlendMode mode, float (&values)[4])
{
  std::fill(values, values + 3, 0.0f);
  values[3] = GetBlendModel(mode).HidesBehind() ? 1.0f : 0.0f;
}

//------------------------------------------------------------------------------
void JoinValues(BlendMode mode, const float (&behind)[4], float (&values)[4])
{
  const BlendModel& model = GetBlendModel(mode);
  if (model.HidesBehind())
  {
    JoinColors(behind, values);
    return;
  }
  if (behind[1] > 0.0f)
  {
    values[0] = values[1] > 0.0f ? JoinNumbers(model.Kept, values[0], behind[0]) : behind[0];
    values[1] += behind[1];
  }
}

//------------------------------------------------------------------------------
void FinishValues(const PacketJob& job, const float (&values)[4], float (&color)[4])
{
  switch (job.Blending)
  {
#define MENISCUS_FINISH(name, number, label, model, ...)                                           \
  case BlendMode::name:                                                                            \
    FinishOf<model<SimdPortable>>(job, values, color);                                             \
    break;
    MENISCUS_BLEND_MODES(MENISCUS_FINISH)
#undef MENISCUS_FINISH
  }
}

}
