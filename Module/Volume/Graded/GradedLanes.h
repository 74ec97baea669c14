// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Graded/GradedCellTable.h"

#include <cstdint>

namespace meniscus
{

/**
 * Steps of several bent rays at once, one lane each, with the instructions of a set.
 *
 * A step takes a ray through one cell by the same series as GradedPassage, without its branches:
 * the face that a straight way would leave by, Newton's method on the series of that face's weight,
 * and a proof that no other weight fell below 0 before. Where the proof fails, the lane stays as it
 * is, and its ray needs a step of GradedRayWalk: at ties, near edges, in strongly curved fields, in
 * flat and inverted cells. Lanes may end on the boundary, where GradedRayWalk takes the ray on.
 *
 * The parts of a step follow each other for all lanes, since each one is a long chain of operations
 * that wait for one another: processors compute those of other lanes in the meantime.
 *
 * The proof: up to its terms of the second order, a weight is above the smaller of its tangent and
 * its chord, both of which begin at 0 or above. So it is if tangent and weight at the end exceed
 * twice the sum of all higher terms.
 */
struct alignas(64) GradedLanes
{
  /** Largest number of lanes. Arrays, rows and numbers between the parts of a step fit into L1. */
  static constexpr int Size = 64;
  /** Terms of the series up to this order are summed. */
  static constexpr int Order = 5;
  /**
   * Largest share of the way in a cell that the terms left out may be. Over a path of the length of
   * the mesh's radius they add up to 2^-15 of the rounding of the mesh's positions.
   */
  static constexpr double LargestRest = 0x1p-46;

  /**
   * Largest number of steps in a row that are short enough for a zigzag (GradedRayWalk.h). The next
   * one is left to the walk of the ray alone, which knows what to do about a zigzag.
   */
  static constexpr double MostShortSteps = 64.0;

  /** Row of each lane's cell; of any cell behind the lanes in use. */
  const GradedCellRow* Rows[Size];
  /** Place relative to the mesh's centre and momentum. */
  double Place[3][Size];
  double Momentum[3][Size];
  /** Face by which the ray has come, 0 to 3, and the weights of its vertices, ascending. */
  std::int32_t Entry[Size];
  double Weights[3][Size];
  /** Integral of n^2 along the steps of the lane. */
  double OpticalPath[Size];
  /** Number of steps after which the lane stays. */
  double StepsLeft[Size];
  /** Number of short steps in a row, up to now. */
  double ShortSteps[Size];
  /** Face by which the ray has left its cell, 0 to 3; -1 if the lane has stayed. */
  std::int32_t Exit[Size];

  /** Lanes in use, from the first one on. It stands last, so that all arrays fill whole lines. */
  int Count = 0;
};
static_assert(GradedLanes::Size % 16 == 0, "arrays fill lines of 64 bytes");

/** @pre GetInstructionSets() has the set */
void StepLanes(GradedLanes& lanes, InstructionSet set);

}
