// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Entry points of the packet kernels, dispatched to the code of an instruction set. */
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Packet/Data/PacketJob.h"

namespace meniscus
{

/**
 * Casts all rays of the job on the calling thread.
 * @pre GetInstructionSets() has the set
 */
void CastPackets(const PacketJob& job, InstructionSet set);

/**
 * Tests all spans of faces and sets the hits of the job.
 * @pre GetInstructionSets() has the set
 */
void FindEntries(PacketSpanJob& job, InstructionSet set);

}
