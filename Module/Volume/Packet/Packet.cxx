// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/Packet.h"

#include "Volume/Packet/PacketProjection.h"
#include "Volume/Packet/PacketSets.h"
#include "Volume/Packet/SimdPortable.h"

#include <algorithm>

namespace meniscus
{
namespace
{

/** Colour and transmittance are kept, else a number and a length. */
bool HidesWhatIsBehind(PacketBlending blending)
{
  return blending == PacketBlending::Composite || blending == PacketBlending::Isosurfaces;
}

}

//------------------------------------------------------------------------------
bool HasInstructionSet(InstructionSet set)
{
#ifdef MENISCUS_X86
  switch (set)
  {
    case InstructionSet::AVX512:
      return __builtin_cpu_supports("avx512f") != 0;
    case InstructionSet::AVX2:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    default:
      return true;
  }
#else
  return set == InstructionSet::Portable;
#endif
}

//------------------------------------------------------------------------------
InstructionSet BestInstructionSet()
{
  constexpr InstructionSet widestFirst[] = { InstructionSet::AVX512, InstructionSet::AVX2 };
  for (const InstructionSet set : widestFirst)
  {
    if (HasInstructionSet(set))
    {
      return set;
    }
  }
  return InstructionSet::Portable;
}

//------------------------------------------------------------------------------
const char* NameOf(InstructionSet set)
{
  switch (set)
  {
    case InstructionSet::AVX512:
      return "AVX-512";
    case InstructionSet::AVX2:
      return "AVX2";
    default:
      return "portable";
  }
}

//------------------------------------------------------------------------------
void CastPackets(const PacketJob& job, InstructionSet set)
{
#ifdef MENISCUS_X86
  if (set == InstructionSet::AVX512)
  {
    CastPacketsAVX512(job);
    return;
  }
  if (set == InstructionSet::AVX2)
  {
    CastPacketsAVX2(job);
    return;
  }
#endif
  static_cast<void>(set);
  CastPacketsPortable(job);
}

//------------------------------------------------------------------------------
void FindEntered(const PacketFaceJob& job, InstructionSet set)
{
#ifdef MENISCUS_X86
  if (set == InstructionSet::AVX512)
  {
    FindEnteredAVX512(job);
    return;
  }
  if (set == InstructionSet::AVX2)
  {
    FindEnteredAVX2(job);
    return;
  }
#endif
  static_cast<void>(set);
  FindEnteredPortable(job);
}

//------------------------------------------------------------------------------
void ClearValues(PacketBlending blending, float (&values)[4])
{
  std::fill(values, values + 3, 0.0f);
  values[3] = HidesWhatIsBehind(blending) ? 1.0f : 0.0f;
}

//------------------------------------------------------------------------------
void JoinValues(PacketBlending blending, const float (&behind)[4], float (&values)[4])
{
  if (HidesWhatIsBehind(blending))
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      values[channel] += values[3] * behind[channel];
    }
    values[3] *= behind[3];
    return;
  }
  if (!(behind[1] > 0.0f))
  {
    return;
  }
  const bool sums = blending == PacketBlending::Average || blending == PacketBlending::Additive;
  if (sums || !(values[1] > 0.0f))
  {
    values[0] = values[1] > 0.0f ? values[0] + behind[0] : behind[0];
  }
  else
  {
    values[0] = blending == PacketBlending::Maximum ? std::max(values[0], behind[0])
                                                    : std::min(values[0], behind[0]);
  }
  values[1] += behind[1];
}

//------------------------------------------------------------------------------
void FinishValues(const PacketJob& job, const float (&values)[4], float (&color)[4])
{
  if (HidesWhatIsBehind(job.Blending))
  {
    FinishBlended<SimdPortable>(values, color);
    return;
  }
  PacketProjection<SimdPortable>::Finish(job, { values[0], values[1] }, color);
}

}
