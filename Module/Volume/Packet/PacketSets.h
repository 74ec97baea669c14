// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_PacketSets_h
#define meniscus_Volume_Packet_PacketSets_h

#include "Volume/Packet/Packet.h"

namespace meniscus
{

// The ray caster per instruction set, each compiled with the compiler options of its own.
void CastPacketsPortable(const PacketJob& job);
void CastPacketsAVX2(const PacketJob& job);
void CastPacketsAVX512(const PacketJob& job);

// Likewise.
void FindEnteredPortable(const PacketFaceJob& job);
void FindEnteredAVX2(const PacketFaceJob& job);
void FindEnteredAVX512(const PacketFaceJob& job);

}

#endif
