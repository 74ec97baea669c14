// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraProjection.glsl (one number per ray)
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/CompensatedSum.h"
#include "Volume/Packet/Models/PacketIntervals.h"
#include "Volume/Packet/Models/PacketLanes.h"

#include <cstdint>

namespace meniscus
{

/**
 * Blending that keeps one number per ray: the largest or smallest scalar or the scalar's mean,
 * mapped by the transfer function, or the integral of attenuation times the scalar's position in
 * the data's range, shown as a grey level. The same interface as CompositeModel.
 */
template <class Simd>
class IntensityProjectionModel
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit IntensityProjectionModel(const PacketJob& job)
    : Blending(job.Blending)
    , Intervals(job.Intervals, job.NumberOfIntervals)
    , Seen(Simd::Splat(0.0f))
    , From(Simd::Splat(0.0f))
    , To(Simd::Splat(0.0f))
    , Remaining(Simd::Splat(0.0f))
    , ShareAtZero(Simd::Splat(job.ShareAtZero))
    , SharePerScalar(Simd::Splat(job.SharePerScalar))
  {
  }

  void Reset(Mask lanes)
  {
    const Float zero = Simd::Splat(0.0f);
    const Float neutral = Simd::Splat(this->Blending == BlendMode::MaximumIntensity
        ? -1.0e+30f
        : (this->Blending == BlendMode::MinimumIntensity ? 1.0e+30f : 0.0f));
    this->Collected.Reset(lanes, neutral);
    this->Seen = Simd::Select(lanes, zero, this->Seen);
  }

  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place&)
  {
    return this->Begin(lanes, from, to, length);
  }
  Mask Advance(Mask lanes);
  void Enter(Mask) {}

  /** All lanes: nothing is occluded in these modes. */
  Mask IsOn() const { return Simd::FromBits(AllLanes<Simd>); }

  /** False: jumps of the scalar between cells, for scalars of cells, are not used. */
  static constexpr bool SeesJumps = false;
  static constexpr int NumberOfTriples = 0;
  static constexpr bool UsesCellGradients = false;
  static constexpr bool UsesLines = false;
  static constexpr int NumberOfValues = 2;
  /** Values of a ray that meets nothing. */
  static constexpr float Empty[NumberOfValues] = { 0.0f, 0.0f };
  /**
   * Larger parts of an integral, which is shown up to 1, count as this: sums of infinity and its
   * rounding error would not be numbers.
   */
  static constexpr float LargestTerm = 18446744073709551616.0f; // 2^64
  /** Value of each lane, and the length over which it was collected. */
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    Simd::Store(values[0], this->Collected.Get());
    Simd::Store(values[1], this->Seen);
  }
  static void Finish(
    const PacketJob& job, const float (&values)[NumberOfValues], float (&color)[4]);

private:
  Mask Begin(Mask lanes, Float from, Float to, Float length);

  BlendMode Blending;
  PacketIntervals<Simd> Intervals;
  CompensatedSum<Simd> Collected;
  /** Length of the ray's segments so far. */
  Float Seen;
  Float From;
  Float To;
  Float Remaining;
  /** Position of a scalar in the data's range, 0 to 1. */
  Float ShareAtZero;
  Float SharePerScalar;
};

//------------------------------------------------------------------------------
template <class Simd>
auto IntensityProjectionModel<Simd>::Begin(Mask lanes, Float from, Float to, Float length) -> Mask
{
  const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
  this->Seen = Simd::Select(valid, this->Seen + length, this->Seen);
  switch (this->Blending)
  {
    case BlendMode::MaximumIntensity:
      this->Collected.Set(valid, Simd::Max(this->Collected.Get(), Simd::Max(from, to)));
      break;
    case BlendMode::MinimumIntensity:
      this->Collected.Set(valid, Simd::Min(this->Collected.Get(), Simd::Min(from, to)));
      break;
    case BlendMode::AverageIntensity:
      this->Collected.Add(valid, Simd::Splat(0.5f) * (from + to) * length);
      break;
    default:
      this->From = Simd::Select(valid, from, this->From);
      this->To = Simd::Select(valid, to, this->To);
      this->Remaining = Simd::Select(valid, length, this->Remaining);
      return valid;
  }
  return Simd::FromBits(0);
}

//------------------------------------------------------------------------------
/** Attenuation times scalar is quadratic along a part within an interval: Simpson's rule is exact.
 */
template <class Simd>
auto IntensityProjectionModel<Simd>::Advance(Mask lanes) -> Mask
{
  if (Simd::Bits(lanes) == 0)
  {
    return lanes;
  }
  const Float zero = Simd::Splat(0.0f);
  const Float half = Simd::Splat(0.5f);
  const auto part = this->Intervals.FindPart(lanes, this->From, this->To);
  const auto& fields = this->Intervals.GetFields();
  const Float to = part.To;
  const Float length = part.Share * this->Remaining;
  const auto valueAt = [&](Float scalar)
  {
    const Float attenuation =
      Simd::Fma(scalar - fields.Lower, fields.AttenuationSlope, fields.Attenuation);
    return Simd::Max(attenuation, zero) *
      Simd::Fma(this->SharePerScalar, scalar, this->ShareAtZero);
  };
  const Float mean = Simd::Splat(1.0f / 6.0f) * (valueAt(this->From) + valueAt(to)) +
    Simd::Splat(2.0f / 3.0f) * valueAt(half * (this->From + to));
  this->Collected.Add(lanes, Simd::Min(length * mean, Simd::Splat(LargestTerm)));
  this->Remaining = Simd::Select(lanes, this->Remaining - length, this->Remaining);
  this->From = Simd::Select(lanes, to, this->From);
  this->Intervals.Move(part.Upward, part.Downward);
  return part.Upward | part.Downward;
}

//------------------------------------------------------------------------------
template <class Simd>
void IntensityProjectionModel<Simd>::Finish(
  const PacketJob& job, const float (&values)[NumberOfValues], float (&color)[4])
{
  const auto unit = [](float x) { return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f; };
  if (!(values[1] > 0.0f))
  {
    color[0] = color[1] = color[2] = color[3] = 0.0f;
    return;
  }
  if (job.Blending == BlendMode::Additive)
  {
    color[0] = color[1] = color[2] = unit(values[0]);
    color[3] = 1.0f;
    return;
  }
  const float scalar =
    job.Blending == BlendMode::AverageIntensity ? values[0] / values[1] : values[0];
  const PacketInterval& interval =
    job.Intervals[PacketIntervals<Simd>::IndexOf(job.Intervals, job.NumberOfIntervals, scalar)];
  const float offset = scalar - interval.Lower;
  color[3] = unit(interval.Attenuation + offset * interval.AttenuationSlope);
  for (int channel = 0; channel < 3; ++channel)
  {
    color[channel] = color[3] * (interval.Color[channel] + offset * interval.ColorSlope[channel]);
  }
}

}
