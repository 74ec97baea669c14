// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketRays.h"

#include <cstdint>

namespace meniscus
{

/** Straight lines of up to 64 neighbouring rays in a frame of refracted rays, as arrays. */
struct LineBlock
{
  static constexpr int Size = 64;

  int Count = 0;
  /** (x, y) = Origin + depth * Slope in the frame, see FrameLine. */
  double Origin[2][Size] = {};
  double Slope[2][Size] = {};
  /** Depth from which on entries are collected. */
  double From[Size] = {};
  /** The lines as in PacketRay. */
  std::int32_t Offset[2][Size] = {};
  float GridSlope[2][Size] = {};
  float Fraction[2][Size] = {};
  float SlopeRest[2][Size] = {};
  float LengthPerDepth[Size] = {};
  float StartDepth[Size] = {};
  float EndDepth[Size] = {};

  /** The line as a ray without entries. */
  PacketRay GetRay(int i) const
  {
    PacketRay ray;
    for (int axis = 0; axis < 2; ++axis)
    {
      ray.Offset[axis] = this->Offset[axis][i];
      ray.Slope[axis] = this->GridSlope[axis][i];
      ray.Fraction[axis] = this->Fraction[axis][i];
      ray.SlopeRest[axis] = this->SlopeRest[axis][i];
    }
    ray.LengthPerDepth = this->LengthPerDepth[i];
    ray.StartDepth = this->StartDepth[i];
    ray.EndDepth = this->EndDepth[i];
    ray.FirstEntry = 0;
    ray.EndEntry = 0;
    return ray;
  }
  void SetRay(int i, const PacketRay& ray)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Offset[axis][i] = ray.Offset[axis];
      this->GridSlope[axis][i] = ray.Slope[axis];
      this->Fraction[axis][i] = ray.Fraction[axis];
      this->SlopeRest[axis][i] = ray.SlopeRest[axis];
    }
    this->LengthPerDepth[i] = ray.LengthPerDepth;
    this->StartDepth[i] = ray.StartDepth;
    this->EndDepth[i] = ray.EndDepth;
  }
  /** Appends line `i` of a block, with entries from the depth `from` on. */
  void Add(const LineBlock& block, int i, double from)
  {
    const int line = this->Count++;
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Origin[axis][line] = block.Origin[axis][i];
      this->Slope[axis][line] = block.Slope[axis][i];
    }
    this->From[line] = from;
    this->SetRay(line, block.GetRay(i));
  }
};

}
