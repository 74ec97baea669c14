// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: what only some models ask the walk for.
#ifndef meniscus_Volume_Packet_PacketWalkOptics_h
#define meniscus_Volume_Packet_PacketWalkOptics_h

#include "Volume/Packet/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/** The vertices that the faces do not have. */
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
/**
 * Gradient of the scalar in the cell of ABC and x, in the frame of the rays; 0 without volume. It
 * is solved for about the ray, where small cells have small coordinates, and sheared back: with
 * u = x - slope depth, d/dx is d/du, and d/d(depth) there is slope d/du less here.
 */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::FindCellGradient(const Corner& x)
{
  // A difference of depths of half of the mesh, 2^30, may not fit; its float is good enough.
  const auto depthOf = [&](const Corner& corner)
  {
    const Float rough = Simd::Splat(1.0f / PacketVertex::DepthUnit) * (corner.Depth - x.Depth);
    return Simd::Select(Simd::Abs(rough) < Simd::Splat(1073741824.0f),
      Simd::ToFloat(corner.GridDepth[0] - x.GridDepth[0]), rough);
  };
  const auto edgeTo = [&](const Corner& corner) {
    return std::array<Float, 3>{ corner.U - x.U, corner.V - x.V, depthOf(corner) };
  };
  const std::array<Float, 3> a = edgeTo(this->A);
  const std::array<Float, 3> b = edgeTo(this->B);
  const std::array<Float, 3> c = edgeTo(this->C);
  const Float changes[3] = { this->A.Scalar - x.Scalar, this->B.Scalar - x.Scalar,
    this->C.Scalar - x.Scalar };
  const auto component = [](const std::array<Float, 3>& p, const std::array<Float, 3>& q, int i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    return Simd::CrossProduct(p[j], p[k], q[j], q[k]);
  };
  const Float zero = Simd::Splat(0.0f);
  Float volume = zero;
  for (int i = 0; i < 3; ++i)
  {
    const Float bc = component(b, c, i);
    volume = Simd::Fma(a[i], bc, volume);
    this->CellGradient[i] = Simd::Fma(
      changes[0], bc, Simd::Fma(changes[1], component(c, a, i), changes[2] * component(a, b, i)));
  }
  const Mask real = Simd::Abs(volume) > zero;
  const auto perUnit = [&](Float sum, double unit)
  {
    const Float scale = Simd::Splat(static_cast<float>(1.0 / unit));
    return Simd::Select(real, scale * (sum / volume), zero);
  };
  const Float perX = perUnit(this->CellGradient[0], this->Job.GridUnit);
  const Float perY = perUnit(this->CellGradient[1], this->Job.GridUnit);
  const Float perDepth = perUnit(this->CellGradient[2], PacketVertex::DepthUnit);
  this->CellGradient = { perX, perY,
    perDepth - Simd::Fma(this->Line.SlopeX, perX, this->Line.SlopeY * perY) };
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
      // What is shifted out is rounded down: offsets are half a unit larger.
      places[axis][lane] = static_cast<float>(unit * (offset - 0.5));
    }
  }
  this->Line = { Simd::Load(places[0]), Simd::Load(places[1]), Simd::Load(slopes[0]),
    Simd::Load(slopes[1]) };
}

}

#endif
