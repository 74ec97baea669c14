// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/** One leg of the rays of a tile. */
struct TileLeg
{
  int Tile;
  int Number;
  BoundaryRaster::PixelBox Box;
  /** Window depth in [0, 1] per pixel of the image, at which rays end; null for none. */
  const float* OpaqueDepth;
  /** Rays of a pixel along each axis. */
  int RaysAcross = 1;
  /** Rays of the tile that are cast, each once; null for all of them. */
  const std::vector<std::int16_t>* Selected = nullptr;
  /** True if the workspace has the lines of all rays of the tile, with their entries. */
  bool IsListed = false;
};

/** Lines of one leg in one frame that enter the mesh, ready to be cast. */
struct LegBatch
{
  /** Pixel of a line. */
  struct Origin
  {
    /** Number of the pixel in the tile, in rows of RefractedRayTiles::TileSize. */
    std::int32_t Pixel;
    /** True if the line is drawn up to the next interface. */
    bool ReachesInterface;
  };
  std::vector<PacketRay> Rays;
  /** One per ray. */
  std::vector<Origin> Origins;
  const PacketEntry* Entries = nullptr;

  void Clear()
  {
    this->Rays.clear();
    this->Origins.clear();
  }
};

}
