// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_Kernels_PacketFaces_h
#define meniscus_Volume_Packet_Kernels_PacketFaces_h

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

  /** Lines of rays in x and y, as in PacketRay. */
  struct Rays
  {
    Int Offset[2];
    Float Slope[2];
    /** False if all fractions are 0; they need not be set then. */
    bool HasFractions;
    Float Fraction[2];
  };

  PacketFaceTest(const PacketVertex* vertices, std::int32_t pivot)
    : Vertices(vertices)
    , Pivot(pivot)
  {
  }

  /** Takes the face for the calls that follow. */
  void Take(const PacketFace& face)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Ids[k] = face.Vertices[k];
      this->Seen[k] = this->Vertices + face.Vertices[k];
      this->Depths[k] = static_cast<float>(this->Seen[k]->Place[2] - this->Pivot);
    }
  }

  /** Lanes whose ray enters by the face. */
  Mask Test(const Rays& rays);

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
  std::int32_t Ids[3] = {};
  const PacketVertex* Seen[3] = {};
  float Depths[3] = {};
  /** Twice the areas that the edges 01, 12, 20 span with the rays. */
  Float Areas[3];
};

//------------------------------------------------------------------------------
template <class Simd>
inline auto PacketFaceTest<Simd>::Test(const Rays& rays) -> Mask
{
  Corner corners[3];
  for (int k = 0; k < 3; ++k)
  {
    const Float depth = Simd::Splat(this->Depths[k]);
    const auto aboutRay = [&](int axis)
    {
      Float place = Simd::ToFloat(Simd::Splat(this->Seen[k]->Place[axis]) - rays.Offset[axis]);
      if (rays.HasFractions)
      {
        place = place - rays.Fraction[axis];
      }
      return Simd::SubtractProduct(place, rays.Slope[axis], depth);
    };
    corners[k] = { aboutRay(0), aboutRay(1) };
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

//------------------------------------------------------------------------------
/** Tests which rays enter by which faces. */
template <class Simd>
void FindEnteredWith(const PacketFaceJob& job)
{
  constexpr int width = Simd::Width;
  PacketFaceTest<Simd> test(job.Vertices, job.Pivot);
  for (std::int32_t face = 0; face < job.NumberOfFaces; ++face)
  {
    job.Entered[face] = 0;
  }
  for (std::int32_t first = 0; first < job.NumberOfRays; first += width)
  {
    std::int32_t offsets[2][width];
    float fractions[2][width];
    float slopes[2][width];
    std::uint64_t valid = 0;
    for (int lane = 0; lane < width; ++lane)
    {
      const bool isRay = first + lane < job.NumberOfRays;
      valid |= isRay ? 1u << lane : 0u;
      const PacketRay& ray = job.Rays[isRay ? first + lane : first];
      for (int axis = 0; axis < 2; ++axis)
      {
        offsets[axis][lane] = ray.Offset[axis];
        fractions[axis][lane] = ray.Fraction[axis];
        slopes[axis][lane] = ray.Slope[axis];
      }
    }
    const typename PacketFaceTest<Simd>::Rays rays{ { Simd::Load(offsets[0]),
                                                      Simd::Load(offsets[1]) },
      { Simd::Load(slopes[0]), Simd::Load(slopes[1]) }, true,
      { Simd::Load(fractions[0]), Simd::Load(fractions[1]) } };
    for (std::int32_t face = 0; face < job.NumberOfFaces; ++face)
    {
      test.Take(job.Faces[face]);
      job.Entered[face] |= (Simd::Bits(test.Test(rays)) & valid) << first;
    }
  }
}

//------------------------------------------------------------------------------
/** Finds the entries of a tile's rays. */
template <class Simd>
void FindEntriesWith(PacketSpanJob& job)
{
  constexpr int width = Simd::Width;
  PacketFaceTest<Simd> test(job.Vertices, job.Pivot);
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
      typename PacketFaceTest<Simd>::Rays rays;
      rays.HasFractions = job.Fractions[0] != nullptr;
      for (int axis = 0; axis < 2; ++axis)
      {
        rays.Offset[axis] = Simd::Load(job.Offsets[axis] + first);
        rays.Slope[axis] = Simd::Load(job.Slopes[axis] + first);
        if (rays.HasFractions)
        {
          rays.Fraction[axis] = Simd::Load(job.Fractions[axis] + first);
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

#endif
