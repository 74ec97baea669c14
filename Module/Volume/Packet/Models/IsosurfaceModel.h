// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraIsosurfaces.glsl (isovalues next to a scalar)
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"
#include "Volume/Packet/Models/PacketLanes.h"
#include "Volume/Packet/Models/PacketSurfaces.h"

#include <cstdint>

namespace meniscus
{

/**
 * Isosurfaces, met where the scalar, linear along a segment, passes an isovalue; scalars of cells
 * pass isovalues on the faces where they jump. A scalar equal to an isovalue counts as above it.
 * Segments without length are skipped, though the scalar may pass an isovalue in them (by rounding,
 * along an edge in a surface): a segment that begins beyond the isovalues next to the last scalar
 * meets those between at its start. With scalars of cells, cells that the ray passes in a point
 * count as well: a ray through edges and vertices is treated as displaced, and such a displaced ray
 * meets the faces of these cells.
 * Packets test all segments; the few that meet a surface are processed one by one (CrossSurfaces).
 * The same interface as CompositeModel.
 */
template <class Simd>
class IsosurfaceModel
{
public:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;

  explicit IsosurfaceModel(const PacketJob& job)
    : Job(job)
    , Transmittance(Simd::Splat(1.0f))
    , Lower(Simd::Splat(1.0f))
    , Upper(Simd::Splat(-1.0f))
  {
    this->Reset(Simd::FromBits(AllLanes<Simd>));
  }

  void Reset(Mask lanes)
  {
    this->Transmittance = Simd::Select(lanes, Simd::Splat(1.0f), this->Transmittance);
    this->Enter(lanes);
    const unsigned int bits = Simd::Bits(lanes);
    for (int lane = 0; lane < Simd::Width; ++lane)
    {
      if (bits >> lane & 1u)
      {
        this->States[lane] = { { 0.0f, 0.0f, 0.0f }, 1.0f, 1.0f, -1.0f };
      }
    }
  }

  /** Processes whole segments: none is left pending. */
  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place& place)
  {
    Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
    if (this->Job.CellScalars)
    {
      valid = this->PassedCells(lanes, to, place.Depths);
      from = to;
    }
    // Scalars before and behind a cell without one are not connected.
    this->Enter(Simd::AndNot(lanes & (length > Simd::Splat(0.0f)), valid));
    const auto beyond = [this](Float scalar)
    { return (scalar < this->Lower) | Simd::Not(scalar < this->Upper); };
    const unsigned int crossing = Simd::Bits(valid & (beyond(from) | beyond(to)));
    if (crossing != 0)
    {
      this->Cross(crossing, from, to, place);
    }
    return Simd::FromBits(0);
  }
  Mask Advance(Mask lanes) { return lanes; }
  /** Makes the range empty: the first segment of a part determines its own. */
  void Enter(Mask lanes)
  {
    this->Lower = Simd::Select(lanes, Simd::Splat(1.0f), this->Lower);
    this->Upper = Simd::Select(lanes, Simd::Splat(-1.0f), this->Upper);
  }

  Mask IsOn() const
  {
    return this->Transmittance > Simd::Splat(this->Job.TerminationTransmittance);
  }

  /** True: jumps of the scalar between cells, for scalars of cells, are used. */
  static constexpr bool SeesJumps = true;
  static constexpr int NumberOfTriples = 0;
  static constexpr bool UsesCellGradients = false;
  static constexpr bool UsesLines = false;
  static constexpr int NumberOfValues = 4;
  static constexpr float Empty[NumberOfValues] = { 0.0f, 0.0f, 0.0f, 1.0f };
  /** Premultiplied colour and transmittance of each lane. */
  void Store(float (&values)[NumberOfValues][Simd::Width]) const
  {
    for (int lane = 0; lane < Simd::Width; ++lane)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        values[channel][lane] = this->States[lane].Color[channel];
      }
      values[3][lane] = this->States[lane].Transmittance;
    }
  }
  static void Finish(const PacketJob&, const float (&values)[NumberOfValues], float (&color)[4])
  {
    FinishBlended<Simd>(values, color);
  }

private:
  /**
   * Lanes in cells with a scalar that are passed forwards, or in a point. The depth of a face is
   * off by up to 4 * 2^-24 of the distance from the last one, below 2^31 grid units: the difference
   * of two equal depths may be -1024.
   */
  static Mask PassedCells(Mask lanes, Float scalar, Float depths)
  {
    return lanes & (Simd::Abs(scalar) < Simd::Splat(LargestChange)) &
      (depths > Simd::Splat(-1024.0f));
  }
  template <class Place>
  void Cross(unsigned int lanes, Float from, Float to, const Place& place);

  const PacketJob& Job;
  PacketSurfaceState States[Simd::Width];
  Float Transmittance;
  /** The isovalues next to the scalar. */
  Float Lower;
  Float Upper;
};

//------------------------------------------------------------------------------
template <class Simd>
template <class Place>
void IsosurfaceModel<Simd>::Cross(unsigned int lanes, Float from, Float to, const Place& place)
{
  float starts[Simd::Width];
  float ends[Simd::Width];
  float startDepths[Simd::Width];
  float endDepths[Simd::Width];
  std::int32_t cellFaces[Simd::Width];
  Simd::Store(starts, from);
  Simd::Store(ends, to);
  Simd::Store(startDepths, place.StartDepth);
  Simd::Store(endDepths, place.EndDepth);
  Simd::Store(cellFaces, place.CellFace);
  float transmittances[Simd::Width];
  float lower[Simd::Width];
  float upper[Simd::Width];
  Simd::Store(lower, this->Lower);
  Simd::Store(upper, this->Upper);
  for (int lane = 0; lane < Simd::Width; ++lane)
  {
    PacketSurfaceState& state = this->States[lane];
    if (lanes >> lane & 1u)
    {
      const PacketSegment segment{ starts[lane], ends[lane], startDepths[lane], endDepths[lane],
        cellFaces[lane], place.Rays[lane] };
      state.Lower = lower[lane];
      state.Upper = upper[lane];
      CrossSurfaces(this->Job, segment, state);
      lower[lane] = state.Lower;
      upper[lane] = state.Upper;
    }
    transmittances[lane] = state.Transmittance;
  }
  this->Lower = Simd::Load(lower);
  this->Upper = Simd::Load(upper);
  this->Transmittance = Simd::Load(transmittances);
}

}
