// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Volume/Entries/EntryTiles.h"
#include "Volume/Rays/FixedPointRays.h"

#include <cstdint>

namespace meniscus
{

class OpenGLTables;
class VolumeInput;
struct RayCastFrame;

/**
 * Lists of any length of the entries per tile, made on the processor for shaders: of meshes whose
 * rays enter by more faces than the lists made on the device hold.
 */
class OpenGLEntryLists
{
public:
  /**
   * Pixels along the side of a tile, whose rays share a list of entries: 8 overflows the lists of
   * 7-14 % of the tiles of meshes of 200k cells.
   */
  static constexpr int TileSize = 4;
  /** Faces that the lists made on the device hold. */
  static constexpr int TileCapacity = 32;
  /**
   * The same size where lists have any length: cells that share no points are many, and small.
   * Lists of larger tiles have more faces that a ray does not enter by, of smaller ones more bytes
   * in all.
   */
  static constexpr int LongListTileSize = 2;

  /**
   * Brings the lists of a frame up to date if it wants them, and sends them to the device. Returns
   * false if it does not want them, or if they do not fit.
   */
  bool Update(VolumeInput& input, const RayCastFrame& frame, OpenGLTables& tables);

  /** Times that entries were listed. */
  std::int64_t GetBuilds() const { return this->Version.GetChanges(); }
  std::int64_t GetBytes() const { return this->Tiles.GetBytes(); }

private:
  bool AreWanted(const VolumeInput& input, const RayCastFrame& frame);

  EntryTiles Tiles;
  TableVersion Version;
  /** Rays and boundary that the lists are of. */
  FixedPointRays RaysOfTiles;
  TableVersions BoundaryOfTiles;
  bool Fit = false;
  TableVersion Uploaded;
  BoundaryMeasure Boundary;
  TableVersions Measured;
};

}
