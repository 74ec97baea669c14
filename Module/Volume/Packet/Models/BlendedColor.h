// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"

namespace meniscus
{

/**
 * Premultiplied colour and transmittance of a ray per lane: state and results of the models that
 * blend a medium front to back.
 */
template <class Simd>
class BlendedColor
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  /** @param termination transmittance at or below which a ray ends. */
  explicit BlendedColor(Float termination)
    : Termination(termination)
    , Transmittance(Simd::Splat(1.0f))
  {
    for (Float& channel : this->Color)
    {
      channel = Simd::Splat(0.0f);
    }
  }

  /** Resets lanes to the start of a ray. */
  void Reset(Mask lanes)
  {
    for (Float& channel : this->Color)
    {
      channel = Simd::Select(lanes, Simd::Splat(0.0f), channel);
    }
    this->Transmittance = Simd::Select(lanes, Simd::Splat(1.0f), this->Transmittance);
  }

  /** Lanes whose ray has not been terminated. */
  Mask IsOn() const { return this->Transmittance > this->Termination; }

  /** False: jumps of the scalar between cells, for scalars of cells, are not used. */
  static constexpr bool SeesJumps = false;
  static constexpr int NumberOfValues = 4;
  /** Values of a ray that meets nothing. */
  static constexpr float Empty[NumberOfValues] = { 0.0f, 0.0f, 0.0f, 1.0f };
  /** Premultiplied colour and transmittance of each lane. */
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      Simd::Store(values[channel], this->Color[channel]);
    }
    Simd::Store(values[3], this->Transmittance);
  }
  static void Finish(const PacketJob&, const float (&values)[NumberOfValues], float (&color)[4])
  {
    FinishBlended<Simd>(values, color);
  }

protected:
  Float Termination;
  Float Color[3];
  Float Transmittance;
};

}
