// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace meniscus
{

/** Lines of the lanes' rays in x and y, as in PacketRay. */
template <class Simd>
struct LaneRays
{
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;

  Int Offset[2];
  Float Slope[2];
  /** Set for fine rays only. */
  Float Fraction[2];
  Float SlopeRest[2];

  /**
   * Coordinates u and v of a vertex about the rays.
   * @param place x and y of the vertex in grid units.
   * @param depth grid units from the pivot, and the same as floats.
   */
  void AboutRays(const Int (&place)[2], Float depth, Float (&coordinates)[2]) const
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      coordinates[axis] = Simd::SubtractProduct(
        Simd::ToFloat(place[axis] - this->Offset[axis]), this->Slope[axis], depth);
    }
  }
  /** The same about fine rays. */
  void AboutFineRays(
    const Int (&place)[2], Int depth, Float depthAsFloat, Float (&coordinates)[2]) const
  {
    const Float depthRest = Simd::ToFloat(depth - Simd::ToInt(depthAsFloat));
    for (int axis = 0; axis < 2; ++axis)
    {
      const Int across = place[axis] - this->Offset[axis];
      const Float acrossAsFloat = Simd::ToFloat(across);
      const Float rest = Simd::ToFloat(across - Simd::ToInt(acrossAsFloat)) - this->Fraction[axis];
      const Float lacking =
        Simd::SubtractProduct(Simd::SubtractProduct(rest, this->Slope[axis], depthRest),
          this->SlopeRest[axis], depthAsFloat);
      coordinates[axis] =
        Simd::SubtractProduct(acrossAsFloat, this->Slope[axis], depthAsFloat) + lacking;
    }
  }
};

/**
 * Lanes whose ray, which meets the edge from p to q, is displaced to the left of it
 * (ExactEdgeTest::TurnsLeft()).
 * @param before lanes in which the vertex p is before q.
 */
template <class Simd, class Corner>
inline typename Simd::Mask PassesLeft(const Corner& p, const Corner& q, typename Simd::Mask before)
{
  using Mask = typename Simd::Mask;
  const Mask differ = (p.U < q.U) | (p.U > q.U);
  const Mask level = Simd::Not((p.V < q.V) | (p.V > q.V));
  return (q.V < p.V) | (level & ((q.U > p.U) | Simd::AndNot(before, differ)));
}

/** Words of FaceTurns, by 4 * order of the corners + number of the face in its cell. */
struct FaceTurnTable
{
  std::int32_t Words[32];
};

/**
 * Positions of the corners A, B, C of a face in the cell that is entered by it, and their new
 * positions if the ray leaves by the face in which the opposite vertex X replaces one of them.
 *
 * Cells and faces order vertices in the same way, so the ranks of A, B and C in the face, a
 * permutation of 0, 1, 2, and the place of X in the cell give the places of A, B and C in the cell:
 * ranks from the rank of X on are one higher. A permutation is one number of six: 2 times the rank
 * of A, plus 1 if B is behind C.
 */
template <class Simd>
struct FaceTurns
{
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;

  /** Position of the bits for each dropped corner in a word. */
  static constexpr std::int32_t ShiftOfA = 0;
  static constexpr std::int32_t ShiftOfB = 8;
  static constexpr std::int32_t ShiftOfC = 16;
  /** The two lowest bits are the place of the dropped corner; these are 4 times the next order. */
  static constexpr std::int32_t MaskOfOrder = 0x1c;

  /** 4 times the order of vertices. */
  static Int OrderOf(Int a, Int b, Int c)
  {
    const Int zero = Simd::Splat(0);
    const Int eight = Simd::Splat(8);
    return Simd::Select(a > b, eight, zero) + Simd::Select(a > c, eight, zero) +
      Simd::Select(b > c, Simd::Splat(4), zero);
  }

  /** Ranks of A, B and C from 4 times their order. */
  static void RanksOf(Int order, Int (&ranks)[3])
  {
    const Int zero = Simd::Splat(0);
    const Int one = Simd::Splat(1);
    ranks[0] = Simd::ShiftRight(order, Simd::Splat(3));
    const Int lower = Simd::Select(ranks[0] > zero, zero, one);
    const Int higher = Simd::Select(ranks[0] > one, one, Simd::Splat(2));
    const Mask behind = Simd::And(order, Simd::Splat(4)) > zero;
    ranks[1] = Simd::Select(behind, higher, lower);
    ranks[2] = Simd::Select(behind, lower, higher);
  }

  static constexpr FaceTurnTable Make()
  {
    FaceTurnTable table{};
    constexpr std::int32_t shifts[3] = { ShiftOfA, ShiftOfB, ShiftOfC };
    for (std::int32_t index = 0; index < 24; ++index)
    {
      const std::int32_t face = index % 4;
      const std::int32_t rank = index / 8;
      const std::int32_t lower = rank > 0 ? 0 : 1;
      const std::int32_t higher = rank > 1 ? 1 : 2;
      const bool behind = index / 4 % 2 != 0;
      const std::int32_t ranks[3] = { rank, behind ? higher : lower, behind ? lower : higher };
      for (int drop = 0; drop < 3; ++drop)
      {
        const std::int32_t dropped = ranks[drop] + (ranks[drop] >= face ? 1 : 0);
        std::int32_t next[3] = {};
        for (int k = 0; k < 3; ++k)
        {
          const std::int32_t place = k == drop ? face : ranks[k] + (ranks[k] >= face ? 1 : 0);
          next[k] = place - (place > dropped ? 1 : 0);
        }
        const std::int32_t order = 2 * next[0] + (next[1] > next[2] ? 1 : 0);
        table.Words[index] |= (4 * order + dropped) << shifts[drop];
      }
    }
    return table;
  }
  static const FaceTurnTable Table;
};

template <class Simd>
constexpr FaceTurnTable FaceTurns<Simd>::Table = FaceTurns<Simd>::Make();

}
