// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/Packet.h"

#include "Volume/Packet/PacketSets.h"

namespace meniscus
{

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

}
