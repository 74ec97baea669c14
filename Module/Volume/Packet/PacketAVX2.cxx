// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/PacketCast.h"
#include "Volume/Packet/PacketFaces.h"
#include "Volume/Packet/PacketSets.h"
#include "Volume/Packet/SimdAVX2.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void CastPacketsAVX2(const PacketJob& job)
{
  CastPacketsWith<SimdAVX2>(job);
}

//------------------------------------------------------------------------------
void FindEnteredAVX2(const PacketFaceJob& job)
{
  PacketFaceTest<SimdAVX2>(job).Run();
}

}
