// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "RefractionCheck.h"
#include "StackCase.h"

namespace meniscus::test
{

/** Runs a loop in seven ranges on two threads, the last ranges first. */
void ReversedThreadsLoop(std::size_t count, const RangeBody& body);

/**
 * Solves points behind a list of interfaces and compares every answer with Snell's law, with rays
 * that were traced through every patch, with the way back, and with the same list on two threads
 * and with interfaces of equal indices.
 */
RefractionTally CheckStack(const StackCase& test);

/** The same for a mirror and the law of reflection. */
RefractionTally CheckMirror(const MirrorCase& test);

} // namespace meniscus::test
