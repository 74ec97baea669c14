// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: signs of edges that single precision cannot decide.
#ifndef meniscus_Volume_Packet_Walk_PacketWalkExact_h
#define meniscus_Volume_Packet_Walk_PacketWalkExact_h

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/**
 * Exact signs, in some lanes, of the edges from the vertex ahead to A, B, C; `corners` are the
 * positions of the four vertices in the cell. Areas remain those of the single-precision
 * coordinates, like the areas of the other edges: depth is interpolated by their ratios, and on
 * needles with an aspect ratio of 1e4, exact areas among rounded ones would move it by more than
 * the width of a cell. They are 0 where the signs differ.
 */
template <class Simd, class Model>
void PacketWalk<Simd, Model>::MakeSure(
  unsigned int lanes, const Int (&corners)[4], Float (&areas)[3], Mask (&left)[3]) const
{
  std::int32_t cellFaces[Width];
  std::int32_t places[4][Width];
  float sure[3][Width];
  unsigned int bits[3];
  Simd::Store(cellFaces, this->CellFace);
  for (int c = 0; c < 4; ++c)
  {
    Simd::Store(places[c], corners[c]);
  }
  for (int edge = 0; edge < 3; ++edge)
  {
    Simd::Store(sure[edge], areas[edge]);
    bits[edge] = Simd::Bits(left[edge]);
  }
  for (int lane = 0; lane < Width; ++lane)
  {
    const unsigned int bit = 1u << lane;
    if ((lanes & bit) == 0)
    {
      continue;
    }
    const std::int32_t* cell = this->Job.Cells + 8 * std::int64_t{ cellFaces[lane] >> 2 };
    std::int32_t grid[4][3];
    for (int c = 0; c < 4; ++c)
    {
      grid[c][2] = cell[places[c][lane]];
      const PacketVertex& vertex = this->Job.Vertices[grid[c][2]];
      for (int axis = 0; axis < 2; ++axis)
      {
        const Shift& shift = this->Axes[axis];
        grid[c][axis] = Grid::AboutRay(
          vertex.Place[axis], vertex.Place[2], shift.Slope[lane], shift.Offset[lane % 2][lane / 2]);
      }
    }
    // As in Place().
    const auto rounded = [&grid](int c, int axis)
    { return double{ static_cast<float>(grid[c][axis]) }; };
    for (int edge = 0; edge < 3; ++edge)
    {
      std::int64_t exact;
      const bool turns = Grid::TurnsLeft(grid[0], grid[edge + 1], exact);
      const double area =
        rounded(0, 0) * rounded(edge + 1, 1) - rounded(0, 1) * rounded(edge + 1, 0);
      const bool agrees = exact != 0 && (area > 0.0) == (exact > 0);
      sure[edge][lane] = agrees ? static_cast<float>(area) : 0.0f;
      bits[edge] = turns ? bits[edge] | bit : bits[edge] & ~bit;
    }
  }
  for (int edge = 0; edge < 3; ++edge)
  {
    areas[edge] = Simd::Load(sure[edge]);
    left[edge] = Simd::FromBits(bits[edge]);
  }
}

}

#endif
