// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: values that only some models need.
#ifndef meniscus_Volume_Packet_Walk_PacketWalkOptics_h
#define meniscus_Volume_Packet_Walk_PacketWalkOptics_h

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/** Vertices opposite the faces, which the faces do not contain. */
template <class Simd, class Model>
inline auto PacketWalk<Simd, Model>::OppositeVertices(Int cellFace) const -> Int
{
  std::int32_t at[Width];
  Simd::Store(at, cellFace);
  for (std::int32_t& face : at)
  {
    face = this->Job.Cells[8 * std::int64_t{ face >> 2 } + (face & 3)];
  }
  return Simd::Load(at);
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
inline auto PacketWalk<Simd, Model>::GradientsOf(Int cellFace) const -> CellValues
{
  std::int32_t at[Width];
  Simd::Store(at, cellFace);
  for (std::int32_t& cell : at)
  {
    cell >>= 2;
  }
  CellValues gradients;
  gradients.Gather({ this->Job.CellGradients, nullptr }, Simd::Load(at));
  return gradients;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::LoadLines()
{
  float places[2][Width];
  float slopes[2][Width];
  constexpr double fraction = 1.0 / 4294967296.0; // 2^-32
  const double unit = this->Job.GridUnit;
  for (int axis = 0; axis < 2; ++axis)
  {
    for (int lane = 0; lane < Width; ++lane)
    {
      const double slope = fraction * this->Axes[axis].Slope[lane];
      const double offset =
        fraction * static_cast<double>(this->Axes[axis].Offset[lane % 2][lane / 2]);
      slopes[axis][lane] = static_cast<float>(unit / PacketVertex::DepthUnit * slope);
      // Offsets are half a unit larger because shifting out the fraction rounds down.
      places[axis][lane] = static_cast<float>(unit * (offset - 0.5));
    }
  }
  this->Line = { Simd::Load(places[0]), Simd::Load(places[1]), Simd::Load(slopes[0]),
    Simd::Load(slopes[1]) };
}

}

#endif
