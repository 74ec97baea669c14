// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Walk/PacketCorners.h"

#include <cstdint>

namespace meniscus
{

/** One face and one ray per lane: the signs and the tie rule of PacketWalk. */
template <class Simd>
class PacketFaceTest
{
public:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;

  PacketFaceTest(const PacketVertex* vertices, std::int32_t pivot, bool raysAreFine)
    : Vertices(vertices)
    , Pivot(pivot)
    , RaysAreFine(raysAreFine)
  {
  }

  /** Takes the face for the calls that follow. */
  void Take(const PacketFace& face)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Ids[k] = face.Vertices[k];
      this->Seen[k] = this->Vertices + face.Vertices[k];
      this->GridDepths[k] = this->Seen[k]->Place[2] - this->Pivot;
      this->Depths[k] = static_cast<float>(this->GridDepths[k]);
    }
  }

  /** Lanes whose ray enters by the face. */
  Mask Test(const LaneRays<Simd>& rays)
  {
    Corner corners[3];
    for (int k = 0; k < 3; ++k)
    {
      const Int place[2] = { Simd::Splat(this->Seen[k]->Place[0]),
        Simd::Splat(this->Seen[k]->Place[1]) };
      const Float depth = Simd::Splat(this->Depths[k]);
      Float coordinates[2];
      if (this->RaysAreFine)
      {
        rays.AboutFineRays(place, Simd::Splat(this->GridDepths[k]), depth, coordinates);
      }
      else
      {
        rays.AboutRays(place, depth, coordinates);
      }
      corners[k] = { coordinates[0], coordinates[1] };
    }
    const Float zero = Simd::Splat(0.0f);
    for (int k = 0; k < 3; ++k)
    {
      const Corner& p = corners[k];
      const Corner& q = corners[(k + 1) % 3];
      this->Areas[k] = Simd::CrossProduct(p.U, p.V, q.U, q.V);
    }
    const Float least = Simd::Min(this->Areas[0], Simd::Min(this->Areas[1], this->Areas[2]));
    const Mask inside = least > zero;
    const Mask outside = least < zero;
    if (Simd::Bits(inside | outside) == (1u << Simd::Width) - 1u)
    {
      return inside;
    }
    Mask entered = Simd::Not(outside);
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      const Mask before =
        Simd::FromBits(this->Ids[k] < this->Ids[next] ? (1u << Simd::Width) - 1u : 0u);
      entered =
        entered & ((this->Areas[k] > zero) | PassesLeft<Simd>(corners[k], corners[next], before));
    }
    return entered;
  }

  /**
   * Depths at which the rays of the last test that enter do so, in grid units from the pivot. A
   * face without projected area is met at its first vertex.
   */
  Float EntryDepths() const
  {
    const Float total = this->Areas[0] + this->Areas[1] + this->Areas[2];
    const Float first = Simd::Splat(this->Depths[0]);
    const Float toB = Simd::Splat(this->Depths[1] - this->Depths[0]);
    const Float toC = Simd::Splat(this->Depths[2] - this->Depths[0]);
    const Float met = first + (this->Areas[2] * toB + this->Areas[0] * toC) / total;
    return Simd::Select(total > Simd::Splat(0.0f), met, first);
  }

private:
  struct Corner
  {
    Float U;
    Float V;
  };

  const PacketVertex* Vertices;
  std::int32_t Pivot;
  bool RaysAreFine;
  std::int32_t Ids[3] = {};
  const PacketVertex* Seen[3] = {};
  /** Depths from the pivot, and the same as floats. */
  std::int32_t GridDepths[3] = {};
  float Depths[3] = {};
  /** Twice the areas that the edges 01, 12, 20 span with the rays. */
  Float Areas[3];
};

//------------------------------------------------------------------------------
/** Finds the entries of a tile's rays. */
template <class Simd>
void FindEntriesWith(PacketSpanJob& job)
{
  constexpr int width = Simd::Width;
  PacketFaceTest<Simd> test(job.Vertices, job.Pivot, job.RaysAreFine);
  PacketHit* hit = job.Hits;
  std::int32_t taken = -1;
  for (const PacketSpan* span = job.Spans; span != job.Spans + job.NumberOfSpans; ++span)
  {
    if (span->Face != taken)
    {
      taken = span->Face;
      test.Take(job.Faces[taken]);
    }
    for (std::int32_t first = span->First; first < span->End; first += width)
    {
      LaneRays<Simd> rays;
      for (int axis = 0; axis < 2; ++axis)
      {
        rays.Offset[axis] = Simd::Load(job.Offsets[axis] + first);
        rays.Slope[axis] = Simd::Load(job.Slopes[axis] + first);
        if (job.RaysAreFine)
        {
          rays.Fraction[axis] = Simd::Load(job.Fractions[axis] + first);
          rays.SlopeRest[axis] = Simd::Load(job.SlopeRests[axis] + first);
        }
      }
      const std::int32_t left = span->End - first;
      const unsigned int valid = left < width ? (1u << left) - 1u : (1u << width) - 1u;
      unsigned int bits = Simd::Bits(test.Test(rays)) & valid;
      if (bits == 0)
      {
        continue;
      }
      float depths[width];
      Simd::Store(depths, test.EntryDepths());
      for (; bits != 0; bits &= bits - 1)
      {
        const int lane = __builtin_ctz(bits);
        *hit++ = { first + lane, taken, depths[lane] };
      }
    }
  }
  job.NumberOfHits = static_cast<std::int32_t>(hit - job.Hits);
}

}
