// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Simd/InstructionSets.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Rays/FixedPointRays.h"

#include <cstdint>

namespace meniscus
{

class VolumePropertyTables;
struct RayCastFrame;
struct RayCastTables;

/**
 * Scenes of the native caster, made of tables and of a frame. Packet tables are kept as long as
 * their sources are the same.
 */
class NativeScene
{
public:
  NativeScene();

  /** Takes over the transfer function's tables if they have changed. */
  void UpdateProperty(const VolumePropertyTables& property);
  /**
   * Scene of a frame for an image of the given size, with the vertices placed about its rays. It
   * refers to the tables and to this object, and is valid until the next call.
   * @param raysAcross rays of a pixel along each axis (TileCaster::Scene).
   */
  TileCaster::Scene Make(
    RayCastTables& tables, const RayCastFrame& frame, int width, int height, int raysAcross = 1);

  /** Bytes of the tables of the transfer function. */
  std::int64_t GetPropertyBytes() const;
  std::int64_t GetVertexBytes() const;

private:
  PacketTables Tables;
  FixedPointRays PlacedBy;
  TableVersions PlacedVersions;
  TableVersion PropertyVersion;
  InstructionSet Set;
};

}
