// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/PacketCast.h"
#include "Volume/Packet/PacketFaces.h"
#include "Volume/Packet/PacketSets.h"
#include "Volume/Packet/SimdAVX512.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void CastPacketsAVX512(const PacketJob& job)
{
  CastPacketsWith<SimdAVX512>(job);
}

//------------------------------------------------------------------------------
void FindEnteredAVX512(const PacketFaceJob& job)
{
  PacketFaceTest<SimdAVX512>(job).Run();
}

}
