// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Kernels/PacketCast.h"
#include "Volume/Packet/Models/PacketFadedMedium.h"

namespace meniscus
{

template <class Simd, BlendMode Mode, template <class...> class Model>
void CastFadedBlendMode(const PacketJob& job)
{
  if constexpr (GetBlendModel(Mode).IsMedium())
  {
    CastComposite<Simd, Model, PacketFadedMedium>(job);
  }
}

/**
 * Casts a medium that is seen through another one.
 * @pre job.Fading is set, and the blend mode shows a medium
 */
template <class Simd>
void CastFadedPacketsWith(const PacketJob& job)
{
  switch (job.Blending)
  {
#define MENISCUS_CAST(name, number, label, model, ...)                                             \
  case BlendMode::name:                                                                            \
    CastFadedBlendMode<Simd, BlendMode::name, model>(job);                                         \
    break;
    MENISCUS_BLEND_MODES(MENISCUS_CAST)
#undef MENISCUS_CAST
  }
}

}
