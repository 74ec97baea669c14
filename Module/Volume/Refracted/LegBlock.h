// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Legs of many rays at once, compiled per instruction set; as in PatchIntersectionBatch.h. */
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Refracted/LegBox.h"
#include "Volume/Refracted/LineBlock.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

/**
 * Legs of the rays of a square of pixels, as arrays; see RayLeg. Pixels are in the order of the
 * Morton curve, so that the rays of a small square are cast together.
 */
struct LegBlock
{
  /** Side length of the square. */
  static constexpr int Side = 8;
  static constexpr int Size = Side * Side;
  /** Column and row of a pixel in the square: every second bit of its number. */
  static constexpr int ColumnOf(int i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4); }
  static constexpr int RowOf(int i) { return ColumnOf(i >> 1); }

  int Count = 0;
  /** Number of the pixel in its tile. */
  std::int32_t Pixel[Size];
  double Begin[3][Size];
  double Step[3][Size];
  double Depth[Size];
  double End[Size];
  /** Not 0 if the ray has the leg. */
  std::int64_t Exists[Size];
  /** Results of the latest TestLegs(): LegBox::MayMeet() and LegBox::IsBeside(). */
  std::int64_t MayMeet[Size];
  std::int64_t IsBeside[Size];
  /** Part that is drawn, in steps behind Begin; the caller sets it. */
  double DrawnFrom[Size];
  double DrawnTo[Size];
  /** Result of FindFrames(). */
  std::int64_t Frame[Size];

  RayLeg Get(int i) const
  {
    RayLeg leg;
    leg.Begin = { this->Begin[0][i], this->Begin[1][i], this->Begin[2][i] };
    leg.Step = { this->Step[0][i], this->Step[1][i], this->Step[2][i] };
    leg.Depth = this->Depth[i];
    leg.End = this->End[i];
    return leg;
  }
  void Set(int i, const RayLeg& leg)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Begin[axis][i] = leg.Begin[axis];
      this->Step[axis][i] = leg.Step[axis];
    }
    this->Depth[i] = leg.Depth;
    this->End[i] = leg.End;
  }
  /** Repeats the last ray in the lanes that loops over lanes compute besides (RunLanes()). */
  void FillLanes();
  /** Copies pixel, leg, drawn part and frame of ray `from` of another block, or of this one. */
  void Copy(int to, const LegBlock& block, int from);
};

/**
 * Finds leg number `number` of all rays of a square of a tile.
 * @param corner number of its first pixel in the tile.
 * @pre GetInstructionSets() has the set; also for the functions that follow
 */
void FindLegs(
  const RayLegs& legs, int tile, int corner, int number, InstructionSet set, LegBlock& block);

void TestLegs(const LegBox& box, InstructionSet set, LegBlock& block);

/** Finds the index of each leg's frame. */
void FindFrames(const RefractionFrames& frames, InstructionSet set, LegBlock& block);

/**
 * Computes the lines of the legs in a frame.
 * @param legs at least one.
 * @param isOutside true if the beginnings of the legs are known to be outside of the mesh.
 */
void SetLines(const RefractionFrame& frame, LegBlock& legs, bool isOutside, InstructionSet set,
  LineBlock& lines);

}
