// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/CompensatedSum.h"
#include "Volume/Packet/Models/OpticalDepthModel.h"
#include "Volume/Packet/Models/PacketLanes.h"

namespace meniscus
{

/**
 * Measurement of the scalar along rays (MeasuredScalars). Length, integral and optical depth are
 * exact for scalars that are linear in each cell: sums of trapezoids, split at the points of the
 * transfer function. The same interface as CompositeModel.
 */
template <class Simd, bool WithOpticalDepth>
class ScalarMeasureModel
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit ScalarMeasureModel(const PacketJob& job)
    : Segments(job)
    , First(Simd::Splat(0.0f))
    , Last(First)
    , Lowest(First)
    , LowestAt(First)
    , Highest(First)
    , HighestAt(First)
  {
  }

  void Reset(Mask lanes)
  {
    const Float zero = Simd::Splat(0.0f);
    this->Length.Reset(lanes, zero);
    this->Integral.Reset(lanes, zero);
    this->OpticalDepth.Reset(lanes, zero);
    const auto set = [lanes](Float& value, float to)
    { value = Simd::Select(lanes, Simd::Splat(to), value); };
    set(this->First, Far);
    set(this->Last, -Far);
    set(this->Lowest, Far);
    set(this->Highest, -Far);
  }
  void Enter(Mask) {}

  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place& place)
  {
    const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
    this->Measure(valid, from, to, length, place.StartDepth, place.EndDepth);
    if constexpr (WithOpticalDepth)
    {
      this->Segments.Begin(valid, from, to, length);
      return valid;
    }
    return Simd::FromBits(0);
  }
  /** Adds one part of the optical depth. */
  Mask Advance(Mask lanes);

  /** All lanes: rays are measured to their ends. */
  Mask IsOn() const { return Simd::FromBits(AllLanes<Simd>); }

  static constexpr bool SeesJumps = false;
  static constexpr int NumberOfTriples = 0;
  static constexpr bool UsesCellGradients = false;
  static constexpr bool UsesLines = false;
  static constexpr int NumberOfValues = NumberOfMeasuredScalars;
  /** Values of a ray that meets nothing. */
  static constexpr float Empty[NumberOfValues] = {};
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    Simd::Store(values[MeasuredLength], this->Length.Get());
    Simd::Store(values[MeasuredIntegral], this->Integral.Get());
    Simd::Store(values[MeasuredOpticalDepth], this->OpticalDepth.Get());
    Simd::Store(values[MeasuredFirst], this->First);
    Simd::Store(values[MeasuredLast], this->Last);
    Simd::Store(values[MeasuredLowest], this->Lowest);
    Simd::Store(values[MeasuredLowestAt], this->LowestAt);
    Simd::Store(values[MeasuredHighest], this->Highest);
    Simd::Store(values[MeasuredHighestAt], this->HighestAt);
  }

private:
  /** Extremes lie at the ends of a segment; of equal ones, the first along the ray counts. */
  void Measure(Mask valid, Float from, Float to, Float length, Float start, Float end)
  {
    this->Length.Add(valid, length);
    this->Integral.Add(valid, Simd::Splat(0.5f) * (from + to) * length);
    this->First = Simd::Select(valid, Simd::Min(this->First, start), this->First);
    this->Last = Simd::Select(valid, Simd::Max(this->Last, end), this->Last);
    const Float low = Simd::Min(from, to);
    const Mask lower = valid & (low < this->Lowest);
    this->LowestAt = Simd::Select(lower, Simd::Select(to < from, end, start), this->LowestAt);
    this->Lowest = Simd::Select(lower, low, this->Lowest);
    const Float high = Simd::Max(from, to);
    const Mask higher = valid & (high > this->Highest);
    this->HighestAt = Simd::Select(higher, Simd::Select(to > from, end, start), this->HighestAt);
    this->Highest = Simd::Select(higher, high, this->Highest);
  }

  /** Beyond all depths and normalised scalars. */
  static constexpr float Far = 1.0e+30f;

  /** Used with the optical depth only. */
  OpticalDepthSegments<Simd> Segments;
  CompensatedSum<Simd> Length;
  CompensatedSum<Simd> Integral;
  CompensatedSum<Simd> OpticalDepth;
  Float First;
  Float Last;
  Float Lowest;
  Float LowestAt;
  Float Highest;
  Float HighestAt;
};

//------------------------------------------------------------------------------
template <class Simd, bool WithOpticalDepth>
auto ScalarMeasureModel<Simd, WithOpticalDepth>::Advance(Mask lanes) -> Mask
{
  if (!WithOpticalDepth || Simd::Bits(lanes) == 0)
  {
    return lanes;
  }
  return this->Segments.Advance(
    lanes, [this](Mask adding, Float depth) { this->OpticalDepth.Add(adding, depth); });
}

}
