// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of PacketWalk.h: lanes whose ray has ended take the next ray.
#pragma once

#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

//------------------------------------------------------------------------------
/**
 * Assigns the next entry of their ray, or the next ray, to lanes whose walk has ended. Returns the
 * lanes that have a ray.
 */
template <class Simd, class Model>
unsigned int PacketWalk<Simd, Model>::Replace(unsigned int ended)
{
  this->StoreLanes();
  unsigned int busy = Simd::Bits(this->Busy);
  unsigned int entering = 0;
  unsigned int fresh = 0;
  for (unsigned int left = ended; left != 0; left &= left - 1)
  {
    const int lane = __builtin_ctz(left);
    const unsigned int bit = 1u << lane;
    if (this->Ray[lane] >= 0 && this->NextEntry(lane))
    {
      entering |= bit;
      continue;
    }
    if (this->Ray[lane] >= 0)
    {
      this->Finish(lane);
    }
    const bool taken = this->TakeRay(lane);
    entering |= taken ? bit : 0u;
    fresh |= taken ? bit : 0u;
    busy = taken ? busy | bit : busy & ~bit;
  }
  this->Busy = Simd::FromBits(busy);
  this->LoadLanes();
  this->Integral.Reset(Simd::FromBits(fresh));
  this->Enter(Simd::FromBits(entering));
  return busy;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
bool PacketWalk<Simd, Model>::NextEntry(int lane)
{
  const PacketRay& ray = this->Job.Rays[this->Ray[lane]];
  const std::int32_t next = this->Entry[lane] + 1;
  if (next >= ray.EndEntry || this->CellFaces[lane] >= 0 ||
    !(this->DepthsNow[lane] < ray.EndDepth) || !(this->Job.Entries[next].Depth < ray.EndDepth) ||
    (this->OnBits >> lane & 1u) == 0)
  {
    return false;
  }
  this->Entry[lane] = next;
  const PacketEntry& entry = this->Job.Entries[next];
  this->Overlaps[lane] |= this->DepthsNow[lane] - entry.Depth > PacketResult::OverlapDepth ? 1 : 0;
  for (int i = 0; i < 3; ++i)
  {
    this->Ids[i][lane] = entry.Vertices[i];
  }
  this->CellFaces[lane] = entry.CellFace;
  this->Opposites[lane] =
    this->Job.Cells[8 * std::int64_t{ entry.CellFace >> 2 } + (entry.CellFace & 3)];
  return true;
}

//------------------------------------------------------------------------------
/** Starts the next ray that has an entry before its end. Returns false if there is none. */
template <class Simd, class Model>
bool PacketWalk<Simd, Model>::TakeRay(int lane)
{
  while (this->NextRay < this->Job.NumberOfRays)
  {
    const std::int32_t number = this->NextRay++;
    const PacketRay& ray = this->Job.Rays[number];
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Offsets[axis][lane] = ray.Offset[axis];
      this->Slopes[axis][lane] = ray.Slope[axis];
      if (this->Job.RaysAreFine)
      {
        this->Fractions[axis][lane] = ray.Fraction[axis];
        this->SlopeRests[axis][lane] = ray.SlopeRest[axis];
      }
    }
    for (int k = 0; k < Model::NumberOfValues; ++k)
    {
      this->Values[k][lane] = Model::Empty[k];
    }
    this->OnBits |= 1u << lane;
    this->LengthsPerDepth[lane] = ray.LengthPerDepth;
    this->StartDepths[lane] = ray.StartDepth;
    this->EndDepths[lane] = ray.EndDepth;
    this->DepthsNow[lane] = -1.0e+30f;
    this->StepsOf[lane] = this->Overlaps[lane] = 0;
    this->CellFaces[lane] = -1;
    this->Ray[lane] = number;
    this->Entry[lane] = ray.FirstEntry - 1;
    if (this->NextEntry(lane))
    {
      return true;
    }
    this->Finish(lane);
  }
  this->Ray[lane] = -1;
  return false;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::Finish(int lane)
{
  PacketResult& result = this->Job.Results[this->Ray[lane]];
  float values[Model::NumberOfValues];
  for (int k = 0; k < Model::NumberOfValues; ++k)
  {
    values[k] = this->Values[k][lane];
  }
  if constexpr (Model::NumberOfValues > 4)
  {
    float* to = this->Job.Values + std::int64_t{ Model::NumberOfValues } * this->Ray[lane];
    for (int k = 0; k < Model::NumberOfValues; ++k)
    {
      to[k] = values[k];
    }
  }
  else if (this->Job.KeepsValues)
  {
    for (int k = 0; k < Model::NumberOfValues; ++k)
    {
      result.Color[k] = values[k];
    }
  }
  else
  {
    Model::Finish(this->Job, values, result.Color);
  }
  result.End = this->EndOf(lane);
  result.Steps = this->StepsOf[lane];
  result.Overlaps = this->Overlaps[lane];
  result.Lost = this->StepsOf[lane] >= this->StepLimit && this->CellFaces[lane] >= 0 ? 1 : 0;
}

//------------------------------------------------------------------------------
/** PacketResult::End of a finished ray. */
template <class Simd, class Model>
std::int32_t PacketWalk<Simd, Model>::EndOf(int lane) const
{
  const PacketRay& ray = this->Job.Rays[this->Ray[lane]];
  const std::int32_t next = this->Entry[lane] + 1;
  const bool more = next < ray.EndEntry && this->Job.Entries[next].Depth < ray.EndDepth;
  const bool inside = !(this->DepthsNow[lane] < ray.EndDepth);
  if (!inside && !more)
  {
    return PacketResult::Outside;
  }
  return inside && !more && this->CellFaces[lane] >= 0 ? this->CellFaces[lane]
                                                       : PacketResult::Somewhere;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::StoreLanes()
{
  Simd::Store(this->DepthsNow, this->DepthNow);
  Simd::Store(this->StepsOf, this->Steps);
  Simd::Store(this->CellFaces, this->CellFace);
  Simd::Store(this->Opposites, this->Opposite);
  this->Integral.Store(this->Values);
  this->OnBits = Simd::Bits(this->Integral.IsOn());
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::LoadLanes()
{
  this->DepthNow = Simd::Load(this->DepthsNow);
  this->Steps = Simd::Load(this->StepsOf);
  this->CellFace = Simd::Load(this->CellFaces);
  this->Opposite = Simd::Load(this->Opposites);
  this->StartDepth = Simd::Load(this->StartDepths);
  this->EndDepth = Simd::Load(this->EndDepths);
  this->LengthPerDepth = Simd::Load(this->LengthsPerDepth);
  for (int axis = 0; axis < 2; ++axis)
  {
    this->Rays.Offset[axis] = Simd::Load(this->Offsets[axis]);
    this->Rays.Slope[axis] = Simd::Load(this->Slopes[axis]);
    if (this->Job.RaysAreFine)
    {
      this->Rays.Fraction[axis] = Simd::Load(this->Fractions[axis]);
      this->Rays.SlopeRest[axis] = Simd::Load(this->SlopeRests[axis]);
    }
  }
  if constexpr (Model::UsesLines)
  {
    this->LoadLines();
  }
}

}
