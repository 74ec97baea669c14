// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"
#include "Volume/Packet/Models/PacketLanes.h"
#include "Volume/Packet/Models/RayEventSegments.h"

#include <cstdint>

namespace meniscus
{

/**
 * Places on rays at which something is seen (RayEventKind). Packets walk as for other models, but
 * segments are processed one by one in double precision (AddToEvents), and the events of a ray
 * stand in PacketJob::Events, which the caller keeps from leg to leg. The same interface as
 * CompositeModel.
 *
 * Triples: number of vectors per vertex that are interpolated, as PacketWalk gathers them:
 * gradients where the medium has gradients at vertices, then components. CellGradients: gradients
 * of cells are used. Surfaces: isosurfaces, which see the jumps of cells' scalars.
 */
template <class Simd, int Triples, bool CellGradients, bool Surfaces>
class RayEventModel
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit RayEventModel(const PacketJob& job)
    : Job(job)
  {
  }

  void Reset(Mask lanes) { this->OnBits |= Simd::Bits(lanes); }
  /** The next segment of a lane does not continue the last one. */
  void Enter(Mask lanes) { this->ApartBits |= Simd::Bits(lanes); }

  /** Processes whole segments: none is left pending. */
  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place& place)
  {
    const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
    // Scalars before and behind a cell without one are not connected.
    this->Enter(Simd::AndNot(lanes & (length > Simd::Splat(0.0f)), valid));
    const unsigned int bits = Simd::Bits(valid) & this->OnBits;
    if (bits != 0)
    {
      this->Process(bits, from, to, length, place);
    }
    return Simd::FromBits(0);
  }
  Mask Advance(Mask lanes) { return lanes; }

  /** Lanes whose events can change. */
  Mask IsOn() const { return Simd::FromBits(this->OnBits); }

  static constexpr bool SeesJumps = Surfaces;
  static constexpr int NumberOfTriples = Triples;
  static constexpr bool UsesCellGradients = CellGradients;
  static constexpr bool UsesLines = false;
  /** Events are not values of a result; arrays need one element. */
  static constexpr int NumberOfValues = 1;
  static constexpr float Empty[NumberOfValues] = {};
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    Simd::Store(values[0], Simd::Splat(0.0f));
  }
  /** Results are the events: PacketJob::KeepsValues is set. */
  static void Finish(const PacketJob&, const float (&)[NumberOfValues], float (&)[4]) {}

private:
  static constexpr int Width = Simd::Width;
  static constexpr int Size = Triples > 0 ? 3 * Triples : 1;

  template <class Place>
  void Process(unsigned int lanes, Float from, Float to, Float length, const Place& place);

  const PacketJob& Job;
  unsigned int OnBits = AllLanes<Simd>;
  unsigned int ApartBits = AllLanes<Simd>;
};

//------------------------------------------------------------------------------
template <class Simd, int Triples, bool CellGradients, bool Surfaces>
template <class Place>
void RayEventModel<Simd, Triples, CellGradients, Surfaces>::Process(
  unsigned int lanes, Float from, Float to, Float length, const Place& place)
{
  float numbers[5][Width];
  const Float* const stored[5] = { &from, &to, &length, &place.StartDepth, &place.EndDepth };
  for (int i = 0; i < 5; ++i)
  {
    Simd::Store(numbers[i], *stored[i]);
  }
  std::int32_t cellFaces[Width];
  Simd::Store(cellFaces, place.CellFace);
  float values[2][Size][Width] = {};
  for (int i = 0; i < 3 * Triples; ++i)
  {
    Simd::Store(values[0][i], place.StartValues.Of[static_cast<std::size_t>(i)]);
    Simd::Store(values[1][i], place.EndValues.Of[static_cast<std::size_t>(i)]);
  }
  float gradients[3][Width] = {};
  if constexpr (CellGradients)
  {
    for (int i = 0; i < 3; ++i)
    {
      Simd::Store(gradients[i], place.CellGradient.Of[static_cast<std::size_t>(i)]);
    }
  }
  const bool hasFactor = this->Job.Medium && this->Job.Medium->NumberOfOpacityIntervals > 0;
  const bool ofVertices = this->Job.Medium && this->Job.VertexGradients;
  const int components = ofVertices ? 3 : 0;
  for (int lane = 0; lane < Width; ++lane)
  {
    if ((lanes >> lane & 1u) == 0)
    {
      continue;
    }
    float ends[2][Size];
    for (int i = 0; i < Size; ++i)
    {
      ends[0][i] = values[0][i][lane];
      ends[1][i] = values[1][i][lane];
    }
    const float gradient[3] = { gradients[0][lane], gradients[1][lane], gradients[2][lane] };
    RayEventSegment segment{ numbers[0][lane], numbers[1][lane], numbers[2][lane], numbers[3][lane],
      numbers[4][lane], cellFaces[lane] / 4, { nullptr, nullptr }, { nullptr, nullptr } };
    for (int end = 0; end < 2; ++end)
    {
      if (3 * Triples > components)
      {
        segment.Components[end] = ends[end] + components;
      }
      if (hasFactor && (CellGradients || (Triples > 0 && ofVertices)))
      {
        segment.Gradients[end] = CellGradients ? gradient : ends[end];
      }
    }
    RayEventState& state = this->Job.Events[place.Rays[lane]];
    if (this->ApartBits >> lane & 1u)
    {
      state.SurfacesBelow = -1;
      this->ApartBits &= ~(1u << lane);
    }
    if (!AddToEvents(this->Job, segment, state))
    {
      this->OnBits &= ~(1u << lane);
    }
  }
}

}
