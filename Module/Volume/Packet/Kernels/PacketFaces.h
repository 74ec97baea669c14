// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_Kernels_PacketFaces_h
#define meniscus_Volume_Packet_Kernels_PacketFaces_h

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/ExactEdgeTest.h"

#include <cstdint>

namespace meniscus
{

/** Tests which rays enter by which faces, with the signs and the tie rule of PacketWalk. */
template <class Simd>
class PacketFaceTest
{
public:
  explicit PacketFaceTest(const PacketFaceJob& job)
    : Job(job)
  {
  }

  void Run()
  {
    for (std::int32_t face = 0; face < this->Job.NumberOfFaces; ++face)
    {
      this->Job.Entered[face] = 0;
    }
    for (std::int32_t first = 0; first < this->Job.NumberOfRays; first += Width)
    {
      this->TakeRays(first);
      for (std::int32_t face = 0; face < this->Job.NumberOfFaces; ++face)
      {
        const std::uint64_t bits = this->FindEntering(this->Job.Faces[face]) & this->Valid;
        this->Job.Entered[face] |= bits << first;
      }
    }
  }

private:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;
  using Grid = ExactEdgeTest<Simd>;
  static constexpr int Width = Simd::Width;

  void TakeRays(std::int32_t first)
  {
    this->Valid = 0;
    for (int lane = 0; lane < Width; ++lane)
    {
      const bool valid = first + lane < this->Job.NumberOfRays;
      this->Valid |= valid ? 1u << lane : 0u;
      const PacketRay& ray = this->Job.Rays[valid ? first + lane : first];
      for (int axis = 0; axis < 2; ++axis)
      {
        this->Slope[axis][lane] = ray.Slope[axis];
        this->Offset[axis][lane % 2][lane / 2] = ray.Offset[axis];
      }
    }
  }

  unsigned int FindEntering(const PacketFace& face) const
  {
    Float u[3];
    Float v[3];
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t(&place)[3] = this->Job.Vertices[face.Vertices[k]].Place;
      const Int depth = Simd::Splat(place[2]);
      const auto aboutRay = [&](int axis)
      {
        const auto& offset = this->Offset[axis];
        return Simd::ToFloat(Simd::Splat(place[axis]) -
          Simd::MultiplyHigh(depth, this->Slope[axis], offset[0], offset[1]));
      };
      u[k] = aboutRay(0);
      v[k] = aboutRay(1);
    }
    // As in PacketWalk::EdgeArea().
    const Float zero = Simd::Splat(0.0f);
    Float excess = Simd::Splat(1.0f);
    Mask left = Simd::FromBits((1u << Width) - 1u);
    Mask surelyOut = Simd::FromBits(0);
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      const Float area = Simd::CrossProduct(u[k], v[k], u[next], v[next]);
      const Float sure =
        Simd::Abs(area) - Simd::Abs(v[k] * u[next]) * Simd::Splat(Grid::RoundingOfArea);
      excess = Simd::Min(excess, sure);
      surelyOut = surelyOut | ((area < zero) & (sure > zero));
      left = left & (area > zero);
    }
    const unsigned int unsure = ~Simd::Bits(surelyOut) & ~Simd::Bits(excess > zero) & this->Valid;
    return unsure == 0 ? Simd::Bits(left) : this->MakeSure(face, unsure, Simd::Bits(left));
  }

  unsigned int MakeSure(const PacketFace& face, unsigned int lanes, unsigned int bits) const
  {
    for (int lane = 0; lane < Width; ++lane)
    {
      const unsigned int bit = 1u << lane;
      if ((lanes & bit) == 0)
      {
        continue;
      }
      std::int32_t grid[3][3];
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t(&place)[3] = this->Job.Vertices[face.Vertices[k]].Place;
        for (int axis = 0; axis < 2; ++axis)
        {
          grid[k][axis] = Grid::AboutRay(
            place[axis], place[2], this->Slope[axis][lane], this->Offset[axis][lane % 2][lane / 2]);
        }
        grid[k][2] = face.Vertices[k];
      }
      bool enters = true;
      for (int k = 0; k < 3; ++k)
      {
        std::int64_t area;
        enters = enters && Grid::TurnsLeft(grid[k], grid[(k + 1) % 3], area);
      }
      bits = enters ? bits | bit : bits & ~bit;
    }
    return bits;
  }

  const PacketFaceJob& Job;
  unsigned int Valid = 0;
  std::int32_t Slope[2][Width];
  /** Offsets of even and of odd lanes. */
  std::int64_t Offset[2][2][Width / 2];
};

}

#endif
