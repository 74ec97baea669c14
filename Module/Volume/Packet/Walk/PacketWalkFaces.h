// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: points in which rays meet faces.
#pragma once

#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/**
 * Moves a point of the rays to that in which they meet ABC, and returns the difference of the
 * depths. The given scalars are not used. A face without projected area keeps the point; the
 * results of other lanes are undefined.
 * @param met another object than `point`.
 */
template <class Simd, class Model>
inline auto PacketWalk<Simd, Model>::MoveToFace(
  Mask lanes, const FacePoint& point, FacePoint& met) const -> Float
{
  const Float total = this->AreaAB + this->AreaBC + this->AreaCA;
  const Float inverse = Simd::Splat(1.0f) / total;
  // Products are fused in every instruction set: in needles most of the sum cancels.
  const auto meanFrom = [&](Float a, Float b, Float c, Float areaAB, Float areaCA)
  {
    const Float sum = Simd::SubtractProduct(areaAB * (a - c), areaCA, b - a);
    return Simd::SubtractProduct(a, sum, inverse);
  };
  const auto mean = [&](Float a, Float b, Float c)
  { return meanFrom(a, b, c, this->AreaAB, this->AreaCA); };
  const Float ahead[3] = { Simd::ToFloat(point.Whole - this->A.Depth),
    Simd::ToFloat(point.Whole - this->B.Depth), Simd::ToFloat(this->C.Depth - point.Whole) };
  const Float sum = Simd::SubtractProduct(
    Simd::SubtractProduct(this->AreaAB * ahead[2], this->AreaCA, ahead[1]), this->AreaBC, ahead[0]);
  const Float moved = sum * inverse;
  const Int whole = Simd::ToInt(moved);
  Float difference = moved - point.Rest;
  met.Whole = point.Whole + whole;
  met.Rest = moved - Simd::ToFloat(whole);
  // The scalar is relative to the corner with the largest weight. Its rounding errors are small
  // next to every corner, as narrow transfer functions need. Where the corners with weight have one
  // scalar, as along an edge in an isosurface, the result is exactly that scalar.
  const Mask notA = Simd::Max(this->AreaAB, this->AreaCA) > this->AreaBC;
  const Mask c = notA & (this->AreaAB > this->AreaCA);
  const auto rotate = [&](Float ofA, Float ofB, Float ofC)
  { return Simd::Select(c, ofC, Simd::Select(notA, ofB, ofA)); };
  const Float first = rotate(this->A.Scalar, this->B.Scalar, this->C.Scalar);
  const Float second = rotate(this->B.Scalar, this->C.Scalar, this->A.Scalar);
  const Float third = rotate(this->C.Scalar, this->A.Scalar, this->B.Scalar);
  met.Scalar = meanFrom(first, second, third, rotate(this->AreaAB, this->AreaBC, this->AreaCA),
    rotate(this->AreaCA, this->AreaAB, this->AreaBC));
  for (int i = 0; i < VertexValues::Size; ++i)
  {
    met.Values.Of[i] = mean(this->A.Others.Of[i], this->B.Others.Of[i], this->C.Others.Of[i]);
  }
  const Mask flat = Simd::AndNot(lanes, total > Simd::Splat(0.0f));
  if (Simd::Bits(flat) != 0)
  {
    met.Replace(flat, point);
    difference = Simd::Select(flat, Simd::Splat(0.0f), difference);
  }
  return difference;
}

}
