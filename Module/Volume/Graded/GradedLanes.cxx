// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedLanes.h"

namespace meniscus
{

// Defined once per set, by GradedLanesOfSet.cxx.in.
#define MENISCUS_DECLARE_KERNEL(name, label, isSupported, target)                                  \
  void StepLanes##name(GradedLanes& lanes);
MENISCUS_INSTRUCTION_SETS(MENISCUS_DECLARE_KERNEL)
#undef MENISCUS_DECLARE_KERNEL

//------------------------------------------------------------------------------
void StepLanes(GradedLanes& lanes, InstructionSet set)
{
#define MENISCUS_KERNEL(name, label, isSupported, target) StepLanes##name,
  constexpr void (*kernels[])(GradedLanes&) = { MENISCUS_INSTRUCTION_SETS(MENISCUS_KERNEL) };
#undef MENISCUS_KERNEL
  kernels[static_cast<int>(set)](lanes);
}

}
