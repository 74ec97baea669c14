// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraPreIntegrated.glsl (parts of a segment)
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/BlendedColor.h"
#include "Volume/Packet/Models/PacketExponential.h"
#include "Volume/Packet/Models/PacketIntervals.h"
#include "Volume/Packet/Models/PacketSegmentTable.h"

namespace meniscus
{

/**
 * Composite blending of segments by a table (PreIntegration.h), one by one. It exists for
 * comparison with CompositeModel, which has the same interface.
 */
template <class Simd>
class PreIntegratedModel : public BlendedColor<Simd>
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit PreIntegratedModel(const PacketJob& job)
    : BlendedColor<Simd>(Simd::Splat(job.TerminationTransmittance))
    , Table(*job.SegmentTable)
  {
  }

  void Enter(Mask) {}

  /** Processes whole segments: none is left pending. */
  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place&)
  {
    this->Add(SegmentsOf<Simd>(lanes, from, to, length), from, to, length);
    return Simd::FromBits(0);
  }
  Mask Advance(Mask lanes) { return lanes; }

  static constexpr int NumberOfTriples = 0;
  static constexpr bool UsesCellGradients = false;
  static constexpr bool UsesLines = false;

private:
  void Add(Mask lanes, Float from, Float to, Float length);
  void AddWithin(Mask lanes, Float from, Float to, Float length);

  const PacketSegmentTable& Table;
};

//------------------------------------------------------------------------------
/** Outside the range of the table the function is constant, so a segment has up to three parts. */
template <class Simd>
void PreIntegratedModel<Simd>::Add(Mask lanes, Float from, Float to, Float length)
{
  const Float one = Simd::Splat(1.0f);
  const Float zero = Simd::Splat(0.0f);
  const auto placeOf = [this](Float scalar)
  { return (scalar - Simd::Splat(this->Table.Middle)) * Simd::Splat(this->Table.PerHalfRange); };
  const auto within = [&](Float place) { return Simd::Min(Simd::Max(place, zero - one), one); };
  const Float front = placeOf(from);
  const Float back = placeOf(to);
  const Float enters = within(front);
  const Float leaves = within(back);
  const Mask beyond = (Simd::Abs(front) > one) | (Simd::Abs(back) > one);
  if (Simd::Bits(lanes & beyond) == 0)
  {
    this->AddWithin(lanes, front, back, length);
    return;
  }
  // If the scalar does not change, a share is 0 / 0 or infinite, which Min() replaces by 1.
  const auto share = [&](Float part)
  { return Simd::Max(Simd::Min(part / (back - front), one), zero); };
  const Float before = Simd::Select(Simd::Abs(front) > one, share(enters - front), zero);
  const Float inside =
    Simd::Select(beyond, Simd::Min(share(leaves - enters), one - before), one - before);
  this->AddWithin(lanes, enters, enters, before * length);
  this->AddWithin(lanes, enters, leaves, inside * length);
  this->AddWithin(lanes, leaves, leaves, (one - before - inside) * length);
}

//------------------------------------------------------------------------------
template <class Simd>
void PreIntegratedModel<Simd>::AddWithin(Mask lanes, Float from, Float to, Float length)
{
  float fromOf[Simd::Width];
  float toOf[Simd::Width];
  float lengthOf[Simd::Width];
  float means[4][Simd::Width];
  Simd::Store(fromOf, from);
  Simd::Store(toOf, to);
  Simd::Store(lengthOf, length);
  const unsigned int bits = Simd::Bits(lanes);
  for (int lane = 0; lane < Simd::Width; ++lane)
  {
    float mean[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
    if (bits >> lane & 1u)
    {
      LookUpSegment(this->Table, fromOf[lane], toOf[lane], lengthOf[lane], mean);
    }
    else
    {
      lengthOf[lane] = 0.0f;
    }
    for (int i = 0; i < 4; ++i)
    {
      means[i][lane] = mean[i];
    }
  }
  const Float depth = Simd::Load(means[3]) * Simd::Load(lengthOf);
  const Float weight = this->Transmittance * AbsorbedAll<Simd>(depth);
  for (int channel = 0; channel < 3; ++channel)
  {
    this->Color[channel] = Simd::Fma(weight, Simd::Load(means[channel]), this->Color[channel]);
  }
  this->Transmittance = this->Transmittance - weight;
}

}
