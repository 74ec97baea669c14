// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Parts of a scene of packets that pictures and shadows share. */
#pragma once

#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"

namespace meniscus
{

class VolumePropertyTables;
struct RayCastOptics;
struct RayCastTables;

/** Converts the tables of a property to the layout of packets. */
void PackProperty(const VolumePropertyTables& property, PacketTables& packed);

/**
 * Sets the mesh of a scene and everything that its medium depends on, but the tables of the
 * property and the light. The scene refers to `tables`.
 */
void SetMedium(RayCastTables& tables, const RayCastOptics& optics, TileCaster::Scene& scene);

}
