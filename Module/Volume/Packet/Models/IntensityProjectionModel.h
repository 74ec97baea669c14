// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraProjection.glsl (one number per ray)
#ifndef meniscus_Volume_Packet_Models_IntensityProjectionModel_h
#define meniscus_Volume_Packet_Models_IntensityProjectionModel_h

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"

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
    , Collected(Simd::Splat(0.0f))
    , Rest(Simd::Splat(0.0f))
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
    this->Collected = Simd::Select(lanes, neutral, this->Collected);
    this->Rest = Simd::Select(lanes, zero, this->Rest);
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
  Mask IsOn() const { return Simd::FromBits((1u << Simd::Width) - 1u); }

  /** False: jumps of the scalar between cells, for scalars of cells, are not used. */
  static constexpr bool SeesJumps = false;
  static constexpr int NumberOfTriples = 0;
  static constexpr bool UsesCellGradients = false;
  static constexpr bool UsesLines = false;
  static constexpr int NumberOfValues = 2;
  /** Values of a ray that meets nothing. */
  static constexpr float Empty[NumberOfValues] = { 0.0f, 0.0f };
  /** Value of each lane, and the length over which it was collected. */
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    Simd::Store(values[0], this->Collected);
    Simd::Store(values[1], this->Seen);
  }
  static void Finish(
    const PacketJob& job, const float (&values)[NumberOfValues], float (&color)[4]);

private:
  Mask Begin(Mask lanes, Float from, Float to, Float length);
  void Collect(Mask lanes, Float term);

  BlendMode Blending;
  PacketIntervals<Simd> Intervals;
  Float Collected;
  /** Rounding error of the sum: long rays add thousands of small terms. */
  Float Rest;
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
/** Compensated summation (W. Kahan). */
template <class Simd>
inline void IntensityProjectionModel<Simd>::Collect(Mask lanes, Float term)
{
  const Float corrected = term - this->Rest;
  const Float sum = this->Collected + corrected;
  this->Rest = Simd::Select(lanes, (sum - this->Collected) - corrected, this->Rest);
  this->Collected = Simd::Select(lanes, sum, this->Collected);
}

//------------------------------------------------------------------------------
template <class Simd>
auto IntensityProjectionModel<Simd>::Begin(Mask lanes, Float from, Float to, Float length) -> Mask
{
  const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
  this->Seen = Simd::Select(valid, this->Seen + length, this->Seen);
  switch (this->Blending)
  {
    case BlendMode::MaximumIntensity:
      this->Collected =
        Simd::Select(valid, Simd::Max(this->Collected, Simd::Max(from, to)), this->Collected);
      break;
    case BlendMode::MinimumIntensity:
      this->Collected =
        Simd::Select(valid, Simd::Min(this->Collected, Simd::Min(from, to)), this->Collected);
      break;
    case BlendMode::AverageIntensity:
      this->Collect(valid, Simd::Splat(0.5f) * (from + to) * length);
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
  const auto& fields = this->Intervals.GetFields();
  const Mask outside = lanes & ((this->From < fields.Lower) | (this->From > fields.Upper));
  if (Simd::Bits(outside) != 0)
  {
    this->Intervals.Find(outside, this->From);
  }
  const Mask upward = lanes & (this->To > fields.Upper);
  const Mask downward = lanes & (this->To < fields.Lower);
  const Float to = Simd::Min(Simd::Max(this->To, fields.Lower), fields.Upper);
  // 0 / 0, which Min() replaces by 1, if the scalar does not change.
  const Float share = (to - this->From) / (this->To - this->From);
  const Float length = Simd::Max(Simd::Min(share, Simd::Splat(1.0f)), zero) * this->Remaining;
  const auto valueAt = [&](Float scalar)
  {
    const Float attenuation =
      Simd::Fma(scalar - fields.Lower, fields.AttenuationSlope, fields.Attenuation);
    return Simd::Max(attenuation, zero) *
      Simd::Fma(this->SharePerScalar, scalar, this->ShareAtZero);
  };
  const Float sum =
    valueAt(this->From) + valueAt(to) + Simd::Splat(4.0f) * valueAt(half * (this->From + to));
  this->Collect(lanes, length * Simd::Splat(1.0f / 6.0f) * sum);
  this->Remaining = Simd::Select(lanes, this->Remaining - length, this->Remaining);
  this->From = Simd::Select(lanes, to, this->From);
  this->Intervals.Move(upward, downward);
  return upward | downward;
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

#endif
