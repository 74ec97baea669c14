// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/PacketCast.h"
#include "Volume/Packet/PacketFaces.h"
#include "Volume/Packet/PacketSets.h"
#include "Volume/Packet/SimdPortable.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void CastPacketsPortable(const PacketJob& job)
{
  CastPacketsWith<SimdPortable>(job);
}

//------------------------------------------------------------------------------
void FindEnteredPortable(const PacketFaceJob& job)
{
  PacketFaceTest<SimdPortable>(job).Run();
}

}
