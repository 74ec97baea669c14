// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: values that only some models need.
#pragma once

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/** Gradients of cells; 0 if there are none, for scalars of cells. */
template <class Simd, class Model>
inline auto PacketWalk<Simd, Model>::GradientsOf(Int cellFace) const -> CellValues
{
  CellValues gradients;
  if (!this->Job.CellGradients)
  {
    gradients.Clear();
    return gradients;
  }
  std::int32_t at[Width];
  Simd::Store(at, cellFace);
  for (std::int32_t& cell : at)
  {
    cell >>= 2;
  }
  gradients.Gather({ this->Job.CellGradients, nullptr, nullptr }, Simd::Load(at));
  return gradients;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::LoadLines()
{
  const auto unit = static_cast<float>(this->Job.GridUnit);
  const auto slope = static_cast<float>(this->Job.GridUnit * PacketVertex::GridPerDepth);
  const Float zero = Simd::Splat(0.0f);
  const Float one = Simd::Splat(1.0f);
  const Float x = this->Rays.Slope[0] * Simd::Splat(slope);
  const Float y = this->Rays.Slope[1] * Simd::Splat(slope);
  const Float perDepth = one / Simd::Sqrt(Simd::Fma(x, x, Simd::Fma(y, y, one)));
  this->Line = { Simd::ToFloat(this->Rays.Offset[0]) * Simd::Splat(unit),
    Simd::ToFloat(this->Rays.Offset[1]) * Simd::Splat(unit),
    Simd::ToFloat(this->Pivot) * Simd::Splat(PacketVertex::DepthUnit), x, y,
    { zero - x * perDepth, zero - y * perDepth, zero - perDepth } };
}

}
