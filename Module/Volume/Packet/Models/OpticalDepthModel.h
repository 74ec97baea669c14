// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"

namespace meniscus
{

/**
 * Segments whose optical depth is to be added, one per lane: exact for scalars that are linear in
 * each cell, by trapezoids between the points of the transfer function.
 */
template <class Simd>
class OpticalDepthSegments
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit OpticalDepthSegments(const PacketJob& job)
    : Intervals(job.Intervals, job.NumberOfIntervals)
    , From(Simd::Splat(0.0f))
    , To(From)
    , Remaining(From)
  {
  }

  void Begin(Mask valid, Float from, Float to, Float length)
  {
    this->From = Simd::Select(valid, from, this->From);
    this->To = Simd::Select(valid, to, this->To);
    this->Remaining = Simd::Select(valid, length, this->Remaining);
  }
  /**
   * Passes the optical depth of one part of the segments to add(lanes, depth); returns the lanes
   * that have more.
   */
  template <class Add>
  [[gnu::always_inline]] Mask Advance(Mask lanes, const Add& add)
  {
    const auto part = this->Intervals.FindPart(lanes, this->From, this->To);
    const auto& fields = this->Intervals.GetFields();
    const auto attenuationAt = [&fields](Float scalar)
    {
      return Simd::Max(
        Simd::Fma(scalar - fields.Lower, fields.AttenuationSlope, fields.Attenuation),
        Simd::Splat(0.0f));
    };
    const Float length = part.Share * this->Remaining;
    const Float ends = attenuationAt(this->From) + attenuationAt(part.To);
    add(lanes, Simd::Splat(0.5f) * ends * length);
    this->Remaining = Simd::Select(lanes, this->Remaining - length, this->Remaining);
    this->From = Simd::Select(lanes, part.To, this->From);
    this->Intervals.Move(part.Upward, part.Downward);
    return part.Upward | part.Downward;
  }

private:
  PacketIntervals<Simd> Intervals;
  Float From;
  Float To;
  Float Remaining;
};

/**
 * Optical depth of a medium of one scalar along rays (RayMeasuring::OpticalDepth). A ray ends where
 * it has the job's termination transmittance. The same interface as CompositeModel.
 *
 * The sum is not compensated: N terms have an error of at most N 2^-24 of the depth, which changes
 * the transmittance by at most N 2^-24 / e: 2e-5 for 1,000 cells.
 */
template <class Simd>
class OpticalDepthModel
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit OpticalDepthModel(const PacketJob& job)
    : Segments(job)
    , Depth(Simd::Splat(0.0f))
    , Largest(Simd::Splat(-__builtin_logf(job.TerminationTransmittance)))
  {
  }

  void Reset(Mask lanes) { this->Depth = Simd::Select(lanes, Simd::Splat(0.0f), this->Depth); }
  void Enter(Mask) {}

  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place&)
  {
    const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
    this->Segments.Begin(valid, from, to, length);
    return valid;
  }
  /** Adds one part of the optical depth. */
  Mask Advance(Mask lanes)
  {
    if (Simd::Bits(lanes) == 0)
    {
      return lanes;
    }
    const Mask more = this->Segments.Advance(lanes,
      [this](Mask adding, Float depth)
      { this->Depth = Simd::Select(adding, this->Depth + depth, this->Depth); });
    return more & this->IsOn();
  }

  Mask IsOn() const { return this->Depth < this->Largest; }

  static constexpr bool SeesJumps = false;
  static constexpr int NumberOfTriples = 0;
  static constexpr bool UsesCellGradients = false;
  static constexpr bool UsesLines = false;
  static constexpr int NumberOfValues = 1;
  /** Value of a ray that meets nothing. */
  static constexpr float Empty[NumberOfValues] = {};
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    Simd::Store(values[0], this->Depth);
  }
  static void Finish(const PacketJob&, const float (&values)[NumberOfValues], float (&color)[4])
  {
    color[0] = values[0];
  }

private:
  OpticalDepthSegments<Simd> Segments;
  Float Depth;
  Float Largest;
};

}
