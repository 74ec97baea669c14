// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"

namespace meniscus
{

/** Values of a ray that meets nothing. */
void ClearValues(BlendMode mode, float (&values)[4]);

/** Adds the values of a leg of a ray to the values of the legs in front of it. */
void JoinValues(BlendMode mode, const float (&behind)[4], float (&values)[4]);

/** Premultiplied RGBA of values. */
void FinishValues(const PacketJob& job, const float (&values)[4], float (&color)[4]);

}
