// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketJob.h"

#include <cstdint>

namespace meniscus
{

/** State of a ray after the isosurfaces that it has met. */
struct PacketSurfaceState
{
  /** Premultiplied colour. */
  float Color[3];
  float Transmittance;
  /** Isovalues next to the last scalar, the lower one included; unknown if Lower > Upper. */
  float Lower;
  float Upper;
};

/** Part of a ray within a cell, where the scalar is linear. */
struct PacketSegment
{
  float From;
  float To;
  float StartDepth;
  float EndDepth;
  /** 4 * cell + face by which the cell was entered. */
  std::int32_t CellFace;
  std::int32_t Ray;
};

/** Adds the isosurfaces that a segment meets, front to back. */
void CrossSurfaces(const PacketJob& job, const PacketSegment& segment, PacketSurfaceState& state);

}
