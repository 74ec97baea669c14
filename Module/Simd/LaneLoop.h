// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain loops over lanes, compiled once per instruction set by target attributes. All functions
 * that the body calls are inlined into the loop (flatten), so that the compiler can vectorise it
 * and no inline function compiled for a set is shared with other code.
 */
#pragma once

#include "Simd/InstructionSets.h"

namespace meniscus
{

/** Number of lanes that are computed at once: a register of the widest set. */
constexpr int LaneGroup = 8;

#define MENISCUS_LANE_LOOP(name, label, isSupported, target)                                       \
  template <class Kernel, class Lanes>                                                             \
  target __attribute__((flatten)) void RunLanes##name(const Kernel& kernel, Lanes& lanes)          \
  {                                                                                                \
    const Kernel own = kernel; /* stores to lanes cannot change a copy */                          \
    for (int first = 0; first < lanes.Count; first += LaneGroup)                                   \
    {                                                                                              \
      for (int i = first; i < first + LaneGroup; ++i)                                              \
      {                                                                                            \
        own(lanes, i);                                                                             \
      }                                                                                            \
    }                                                                                              \
  }
MENISCUS_INSTRUCTION_SETS(MENISCUS_LANE_LOOP)
#undef MENISCUS_LANE_LOOP

/**
 * Calls kernel(lanes, i) for i in [0, lanes.Count) with the instructions of `set`, and for the
 * lanes behind it up to a multiple of LaneGroup: arrays need room for them, and their results mean
 * nothing.
 * @pre GetInstructionSets() has the set
 */
template <class Kernel, class Lanes>
void RunLanes(const Kernel& kernel, InstructionSet set, Lanes& lanes)
{
  switch (set)
  {
#define MENISCUS_LANE_CASE(name, label, isSupported, target)                                       \
  case InstructionSet::name:                                                                       \
    RunLanes##name(kernel, lanes);                                                                 \
    break;
    MENISCUS_INSTRUCTION_SETS(MENISCUS_LANE_CASE)
#undef MENISCUS_LANE_CASE
  }
}

}
