// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraTransferFunction.glsl (intervals of a function)
#pragma once

#include "Volume/Optics/MediumConstants.h"
#include "Volume/Packet/Data/PacketOptics.h"

#include <cstdint>

namespace meniscus
{

/** Lanes with a segment to draw: of positive length and with finite scalars (LargestChange). */
template <class Simd>
inline typename Simd::Mask SegmentsOf(typename Simd::Mask lanes, typename Simd::Float from,
  typename Simd::Float to, typename Simd::Float length)
{
  return lanes & (Simd::Abs(to - from) < Simd::Splat(LargestChange)) & (length > Simd::Splat(0.0f));
}

/** Premultiplied colour and alpha from colour and transmittance. */
template <class Simd>
inline void FinishBlended(const float (&values)[4], float (&color)[4])
{
  for (int channel = 0; channel < 3; ++channel)
  {
    color[channel] = values[channel];
  }
  color[3] = 1.0f - values[3];
}

/** Intervals of a transfer function, and the interval that holds the scalar of each lane. */
template <class Simd>
class PacketIntervals
{
public:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;

  /** The members of PacketInterval, by lane. */
  struct Fields
  {
    Float Lower;
    Float Upper;
    Float Attenuation;
    Float AttenuationSlope;
    Float Color[4];
    Float ColorSlope[4];
  };

  PacketIntervals(const PacketInterval* table, std::int32_t size);

  /** Fields of the interval of each lane. */
  const Fields& GetFields() const { return this->Now; }

  /** The first interval of a table whose upper end is not below the scalar. */
  static std::int32_t IndexOf(const PacketInterval* table, std::int32_t size, float scalar);

  /** Moves lanes to the interval that holds a scalar. */
  void Find(Mask lanes, Float scalar);

  /** Part of a segment that lies in one interval. */
  struct Part
  {
    /** Scalar at its end. */
    Float To;
    /** Fraction of the segment. */
    Float Share;
    /** Lanes whose segment goes on above or below the interval. */
    Mask Upward;
    Mask Downward;
  };
  /** Moves lanes to the intervals of `from`, and finds the parts of segments in them. */
  Part FindPart(Mask lanes, Float from, Float to)
  {
    const Mask outside = lanes & ((from < this->Now.Lower) | (from > this->Now.Upper));
    if (Simd::Bits(outside) != 0)
    {
      this->Find(outside, from);
    }
    Part part;
    part.Upward = lanes & (to > this->Now.Upper);
    part.Downward = lanes & (to < this->Now.Lower);
    part.To = Simd::Min(Simd::Max(to, this->Now.Lower), this->Now.Upper);
    // 0 / 0, which Min() replaces by 1, if the scalar does not change.
    const Float share = (part.To - from) / (to - from);
    part.Share = Simd::Max(Simd::Min(share, Simd::Splat(1.0f)), Simd::Splat(0.0f));
    return part;
  }

  /** Moves lanes by one interval; few segments leave their interval. */
  void Move(Mask upward, Mask downward)
  {
    if (Simd::Bits(upward | downward) != 0)
    {
      this->At = Simd::Decrement(downward, Simd::Increment(upward, this->At));
      if (this->Size <= Simd::LookupBlock)
      {
        this->template Lookup<1>(); // inlined: a call would save and restore the walk's registers
      }
      else
      {
        this->Fetch();
      }
    }
  }

private:
  static constexpr int NumberOfFields = sizeof(PacketInterval) / sizeof(float);
  static constexpr int LargestColumn = 2 * Simd::LookupBlock;

  template <int Blocks>
  void Lookup()
  {
    Fields& fields = this->Now;
    const auto& table = this->Columns;
    fields.Lower = Simd::template Lookup<Blocks>(table[0], this->At);
    fields.Upper = Simd::template Lookup<Blocks>(table[1], this->At);
    fields.Attenuation = Simd::template Lookup<Blocks>(table[2], this->At);
    fields.AttenuationSlope = Simd::template Lookup<Blocks>(table[3], this->At);
    for (int channel = 0; channel < 3; ++channel)
    {
      fields.Color[channel] = Simd::template Lookup<Blocks>(table[4 + channel], this->At);
      fields.ColorSlope[channel] = Simd::template Lookup<Blocks>(table[8 + channel], this->At);
    }
  }
  void Fetch();

  const PacketInterval* Table;
  std::int32_t Size;
  Int At;
  Fields Now;
  /** The table by field, if it fits. */
  float Columns[NumberOfFields][LargestColumn];
};

//------------------------------------------------------------------------------
template <class Simd>
PacketIntervals<Simd>::PacketIntervals(const PacketInterval* table, std::int32_t size)
  : Table(table)
  , Size(size)
  , At(Simd::Splat(0))
{
  const float* values = &table->Lower;
  for (int field = 0; field < NumberOfFields; ++field)
  {
    for (int i = 0; i < LargestColumn; ++i)
    {
      this->Columns[field][i] = i < size ? values[i * NumberOfFields + field] : 0.0f;
    }
  }
  this->Fetch();
}

//------------------------------------------------------------------------------
template <class Simd>
std::int32_t PacketIntervals<Simd>::IndexOf(
  const PacketInterval* table, std::int32_t size, float scalar)
{
  std::int32_t first = 0;
  std::int32_t last = size - 1;
  while (first < last)
  {
    const std::int32_t middle = (first + last) / 2;
    const bool below = table[middle].Upper < scalar;
    first = below ? middle + 1 : first;
    last = below ? last : middle;
  }
  return first;
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketIntervals<Simd>::Find(Mask lanes, Float scalar)
{
  float scalars[Simd::Width];
  std::int32_t at[Simd::Width];
  Simd::Store(scalars, scalar);
  Simd::Store(at, this->At);
  const unsigned int bits = Simd::Bits(lanes);
  for (int lane = 0; lane < Simd::Width; ++lane)
  {
    if (bits >> lane & 1u)
    {
      at[lane] = IndexOf(this->Table, this->Size, scalars[lane]);
    }
  }
  this->At = Simd::Load(at);
  this->Fetch();
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketIntervals<Simd>::Fetch()
{
  if (this->Size <= Simd::LookupBlock)
  {
    this->template Lookup<1>();
    return;
  }
  if (this->Size <= LargestColumn)
  {
    this->template Lookup<2>();
    return;
  }
  Fields& fields = this->Now;
  const float* first = &this->Table->Lower;
  Simd::template GatherQuads<NumberOfFields>(
    first, this->At, fields.Lower, fields.Upper, fields.Attenuation, fields.AttenuationSlope);
  Simd::template GatherQuads<NumberOfFields>(
    first + 4, this->At, fields.Color[0], fields.Color[1], fields.Color[2], fields.Color[3]);
  Simd::template GatherQuads<NumberOfFields>(first + 8, this->At, fields.ColorSlope[0],
    fields.ColorSlope[1], fields.ColorSlope[2], fields.ColorSlope[3]);
}

}
