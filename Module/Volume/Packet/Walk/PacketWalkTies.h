// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: rays through edges and vertices.
#pragma once

#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/**
 * Decides on which side of the edges from the vertex ahead to A, B, C the rays pass that meet them:
 * the rule of ExactEdgeTest::TurnsLeft().
 */
template <class Simd, class Model>
void PacketWalk<Simd, Model>::BreakTies(
  const Ahead& ahead, const Float (&areas)[3], Mask (&left)[3]) const
{
  Int ranks[3];
  FaceTurns<Simd>::RanksOf(this->Order, ranks);
  const Corner* const corners[3] = { &this->A, &this->B, &this->C };
  for (int k = 0; k < 3; ++k)
  {
    // In the cell, the vertex ahead is before vertices whose ranks in the face are not below its
    // place.
    const Mask before = Simd::Not(ahead.Face > ranks[k]);
    left[k] = left[k] |
      Simd::AndNot(PassesLeft<Simd>(ahead.X, *corners[k], before), areas[k] > Simd::Splat(0.0f));
  }
}

}
