// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_Kernels_KeptValues_h
#define meniscus_Volume_Packet_Kernels_KeptValues_h

#include "Volume/Packet/Data/PacketJob.h"

namespace meniscus
{

/** What a ray that meets nothing keeps. */
void ClearValues(BlendMode mode, float (&values)[4]);

/** Puts the values of what lies behind to those of what lies before. */
void JoinValues(BlendMode mode, const float (&behind)[4], float (&values)[4]);

/** Premultiplied RGBA of kept values. */
void FinishValues(const PacketJob& job, const float (&values)[4], float (&color)[4]);

}

#endif
