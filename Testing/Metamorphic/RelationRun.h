// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ProgrammeOptions.h"
#include "Relation.h"

namespace meniscus::test
{

/**
 * Creates all relations once the options are known. The number of cases grows with the intensity;
 * every case draws from its own stream of random numbers (see SeedOfCase()), so that it can be run
 * alone.
 */
using RelationMaker = std::function<std::vector<Relation>()>;

/**
 * main() of a metamorphic programme: reads the options (--relation, --case, --seed, --intensity,
 * --seconds, --report, and those of `readMore`), runs the cases in processes of their own, so that
 * a crash or an endless loop does not affect the others, and prints the table and the failures.
 * Returns the exit status: success if no relation failed.
 */
int RunMetamorphicProgramme(int argc, char* argv[], const char* usage, ProgrammeOptions& options,
  const OptionReader& readMore, const RelationMaker& make);

/** Number of cases at an intensity: the number at 1 times the intensity, at least 1. */
int CasesAt(double intensity, int atOne);

/** Seed of the random numbers of one case of the relation with the given name. */
std::uint64_t SeedOfCase(std::uint64_t seed, const std::string& relation, int index);

} // namespace meniscus::test
