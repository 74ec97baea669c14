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
 * flat and inverted cells. Lanes may end on the boundary, where GradedRayWalk takes the ray on. The
 * others pass to their next cells.
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
  /** Link to the lane's cell: the face by which the ray has come is its last two bits. */
  std::int32_t Links[Size];
  /** Weights of the vertices of that face, ascending. */
  double Weights[3][Size];
  /** Integral of n^2 along the steps of the lane. */
  double OpticalPath[Size];
  /** Number of short steps in a row, up to now. */
  double ShortSteps[Size];
  /** Face by which the ray has left its cell, 0 to 3; -1 if the lane has stayed. */
  std::int32_t Exit[Size];
  /**
   * Lanes that are not in their next cell after a step, ascending: those that have stayed, and
   * those on the boundary, which are still in their last cell.
   */
  std::int32_t Waiting[Size];

  /** Lanes in use, from the first one on, and those that wait. These stand last, so that all arrays
   * fill whole lines. */
  int Count = 0;
  int WaitingCount = 0;
  /** Rows of all cells. */
  const GradedCellRow* Table = nullptr;
  /** Nonzero for each cell in which lanes stay, whose row then is Impassable; null for none. */
  const std::uint8_t* Watched = nullptr;
  const GradedCellRow* Impassable = nullptr;
};
static_assert(GradedLanes::Size % 16 == 0, "arrays fill lines of 64 bytes");

/** Begins to load a row that the next step needs. Each instruction set has a function of its own.
 */
static inline void Fetch(const GradedCellRow& row)
{
  constexpr int perLine = 8;
  for (int column = 0; column < GradedCellRow::Size; column += perLine)
  {
    __builtin_prefetch(row.Values + column);
  }
}

/** @pre GetInstructionSets() has the set */
void StepLanes(GradedLanes& lanes, InstructionSet set);

}
