// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Registry of the instruction sets that kernels are compiled for. Simd/CMakeLists.txt has one line
 * per set, from which the build makes MENISCUS_INSTRUCTION_SETS, widest set first, Portable last.
 */
#pragma once

#include "Simd/InstructionSetList.h"

#include <vector>

namespace meniscus
{

#define MENISCUS_ENUMERATOR(name, label, isSupported, target) name,
/** The sets that this build has code for. */
enum class InstructionSet
{
  MENISCUS_INSTRUCTION_SETS(MENISCUS_ENUMERATOR)
};
#undef MENISCUS_ENUMERATOR

/**
 * Instruction sets that this build and this processor support, widest first. Never empty: Portable
 * is the last.
 */
const std::vector<InstructionSet>& GetInstructionSets();

/**
 * Widest instruction set that this build and this processor support. The environment variable
 * MENISCUS_INSTRUCTION_SET chooses another of them by its name, for measurements and tests.
 */
InstructionSet BestInstructionSet();

/** Name for messages: "AVX-512", "AVX2", "NEON" or "portable". */
const char* NameOf(InstructionSet set);

}
