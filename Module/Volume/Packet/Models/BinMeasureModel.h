// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/CompensatedSum.h"
#include "Volume/Packet/Models/PacketExponential.h"
#include "Volume/Packet/Models/PacketLanes.h"

namespace meniscus
{

/**
 * Integrals along rays of values per vertex, linear in each cell, or per cell
 * (NumberOfMeasuredBins). With PacketJob::Emitting, the first value is an attenuation coefficient,
 * nowhere negative, and the second one an emission per length; a cell contributes if both are
 * finite. The same interface as CompositeModel.
 */
template <class Simd, bool OfCells>
class BinMeasureModel
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit BinMeasureModel(const PacketJob& job)
    : Emitting(job.Emitting)
    , Attenuation(Simd::Splat(0.0f))
    , AttenuationTo(Attenuation)
    , Emission(Attenuation)
    , EmissionTo(Attenuation)
    , Remaining(Attenuation)
  {
    this->Reset(this->IsOn());
  }

  void Reset(Mask lanes)
  {
    for (CompensatedSum<Simd>& sum : this->Sums)
    {
      sum.Reset(lanes, Simd::Splat(0.0f));
    }
    this->Light.Reset(lanes, Simd::Splat(0.0f));
    this->Transmittance.Reset(lanes, Simd::Splat(1.0f));
  }
  void Enter(Mask) {}

  template <class Place>
  Mask Begin(Mask lanes, Float, Float, Float length, const Place& place)
  {
    const Mask segments = lanes & (length > Simd::Splat(0.0f));
    if constexpr (OfCells)
    {
      return this->Take(segments, place.CellGradient, place.CellGradient, length);
    }
    else
    {
      return this->Take(segments, place.StartValues, place.EndValues, length);
    }
  }
  /** Adds one part of the emission, of an optical depth up to 1/2. */
  Mask Advance(Mask lanes);

  /** All lanes: rays are measured to their ends. */
  Mask IsOn() const { return Simd::FromBits(AllLanes<Simd>); }

  static constexpr bool SeesJumps = false;
  static constexpr int NumberOfTriples = OfCells ? 0 : 1;
  /** The values of cells are in the place of gradients. */
  static constexpr bool UsesCellGradients = OfCells;
  static constexpr bool UsesLines = false;
  static constexpr int NumberOfValues = NumberOfMeasuredBins;
  /** Values of a ray that meets nothing. */
  static constexpr float Empty[NumberOfValues] = {};
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    for (int i = 0; i < 3; ++i)
    {
      Simd::Store(values[i], this->Sums[i].Get());
    }
    Simd::Store(values[3], this->Light.Get());
  }
  /** Results are the values: PacketJob::KeepsValues is set. */
  static void Finish(const PacketJob&, const float (&)[NumberOfValues], float (&)[4]) {}

private:
  template <class Values>
  Mask Take(Mask segments, const Values& from, const Values& to, Float length)
  {
    // Neither infinite nor NaN.
    const auto isFinite = [](Float a, Float b)
    { return Simd::Abs(a) + Simd::Abs(b) < Simd::Splat(3.0e+38f); };
    if (!this->Emitting)
    {
      for (int i = 0; i < 3; ++i)
      {
        this->Sums[i].Add(segments & isFinite(from.Of[i], to.Of[i]),
          Simd::Splat(0.5f) * (from.Of[i] + to.Of[i]) * length);
      }
      return Simd::FromBits(0);
    }
    const Mask valid = segments & isFinite(from.Of[0], to.Of[0]) & isFinite(from.Of[1], to.Of[1]);
    const auto take = [valid](Float& kept, Float value)
    { kept = Simd::Select(valid, value, kept); };
    // Interpolation may round below zero.
    take(this->Attenuation, Simd::Max(from.Of[0], Simd::Splat(0.0f)));
    take(this->AttenuationTo, Simd::Max(to.Of[0], Simd::Splat(0.0f)));
    take(this->Emission, from.Of[1]);
    take(this->EmissionTo, to.Of[1]);
    take(this->Remaining, length);
    return valid;
  }

  bool Emitting;
  CompensatedSum<Simd> Sums[3];
  /** Light of the ray's part so far, and the transmittance of that part. */
  CompensatedSum<Simd> Light;
  CompensatedSum<Simd> Transmittance;
  /** Segment whose emission is to be added. */
  Float Attenuation;
  Float AttenuationTo;
  Float Emission;
  Float EmissionTo;
  Float Remaining;
};

//------------------------------------------------------------------------------
/**
 * Gauss' rule with three points. Emission times transmittance is a linear function times the
 * exponential of a quadratic one; for an optical depth t <= 1/2 and at most 2 t at either end, the
 * rule's error, the sixth derivative over 2016000, is below 1e-7 of the part's emission.
 */
template <class Simd, bool OfCells>
auto BinMeasureModel<Simd, OfCells>::Advance(Mask lanes) -> Mask
{
  if (Simd::Bits(lanes) == 0)
  {
    return lanes;
  }
  const Float one = Simd::Splat(1.0f);
  const Float half = Simd::Splat(0.5f);
  // Where nothing shines through, the rest of the segment is taken at once.
  const Float depthBound = Simd::Max(this->Attenuation, this->AttenuationTo) *
    Simd::Max(this->Remaining, Simd::Splat(0.0f));
  const Mask dark = this->Transmittance.Get() < Simd::Splat(1.0e-30f);
  const Float share =
    Simd::Select(dark, one, Simd::Select(depthBound > half, half / depthBound, one));
  const Float attenuationTo =
    Simd::Fma(share, this->AttenuationTo - this->Attenuation, this->Attenuation);
  const Float emissionTo = Simd::Fma(share, this->EmissionTo - this->Emission, this->Emission);
  const Float length = share * this->Remaining;
  const Float density = this->Attenuation * length;
  const Float change = half * (attenuationTo - this->Attenuation) * length;
  const auto lightFrom = [&](float place)
  {
    const Float x = Simd::Splat(place);
    const Float depth = x * Simd::Fma(x, change, density);
    const Float light = Simd::Fma(x, emissionTo - this->Emission, this->Emission);
    return light * (one - Absorbed<Simd>(Simd::Min(depth, one)));
  };
  const Float mean =
    Simd::Splat(5.0f / 18.0f) * (lightFrom(0.112701665f) + lightFrom(0.887298335f)) +
    Simd::Splat(4.0f / 9.0f) * lightFrom(0.5f);
  const Float transmittance = Simd::Select(dark, Simd::Splat(0.0f), this->Transmittance.Get());
  this->Light.Add(lanes, transmittance * mean * length);
  const Float depth = half * (this->Attenuation + attenuationTo) * length;
  this->Sums[0].Add(lanes, depth);
  this->Transmittance.Add(
    lanes, Simd::Splat(0.0f) - transmittance * Absorbed<Simd>(Simd::Min(depth, one)));
  const auto move = [lanes](Float& kept, Float value) { kept = Simd::Select(lanes, value, kept); };
  move(this->Attenuation, attenuationTo);
  move(this->Emission, emissionTo);
  move(this->Remaining, this->Remaining - length);
  return lanes & (share < one);
}

}
