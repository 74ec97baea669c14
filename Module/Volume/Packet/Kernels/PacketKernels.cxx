// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/Kernels/PacketKernels.h"

namespace meniscus
{

// Defined once per set, by PacketKernelsOfSet.cxx.in and PacketFadedKernelsOfSet.cxx.in.
#define MENISCUS_DECLARE_KERNELS(name, label, isSupported, target)                                 \
  void CastPackets##name(const PacketJob& job);                                                    \
  void CastFadedPackets##name(const PacketJob& job);                                               \
  void FindEntries##name(PacketSpanJob& job);
MENISCUS_INSTRUCTION_SETS(MENISCUS_DECLARE_KERNELS)
#undef MENISCUS_DECLARE_KERNELS

//------------------------------------------------------------------------------
void CastPackets(const PacketJob& job, InstructionSet set)
{
#define MENISCUS_KERNEL(name, label, isSupported, target) CastPackets##name,
  constexpr void (*kernels[])(const PacketJob&) = { MENISCUS_INSTRUCTION_SETS(MENISCUS_KERNEL) };
#undef MENISCUS_KERNEL
#define MENISCUS_KERNEL(name, label, isSupported, target) CastFadedPackets##name,
  constexpr void (*faded[])(const PacketJob&) = { MENISCUS_INSTRUCTION_SETS(MENISCUS_KERNEL) };
#undef MENISCUS_KERNEL
  const bool fades = job.Fading && GetBlendModel(job.Blending).IsMedium();
  (fades ? faded : kernels)[static_cast<int>(set)](job);
}

//------------------------------------------------------------------------------
void FindEntries(PacketSpanJob& job, InstructionSet set)
{
#define MENISCUS_KERNEL(name, label, isSupported, target) FindEntries##name,
  constexpr void (*kernels[])(PacketSpanJob&) = { MENISCUS_INSTRUCTION_SETS(MENISCUS_KERNEL) };
#undef MENISCUS_KERNEL
  kernels[static_cast<int>(set)](job);
}

}
