// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Caster/TileCaster.h"

#include <cstddef>
#include <cstdint>

namespace meniscus
{

/** Calls body(pixel in the image, pixel in the tile) for all pixels of a tile. */
template <class Body>
void ForEachPixel(const TileCaster& caster, int tile, Body&& body)
{
  const BoundaryRaster::PixelBox box = caster.GetBox(tile);
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    for (int column = box.Left; column < box.Right; ++column)
    {
      const int inTile = (row - box.Bottom) * RefractedRayTiles::TileSize + column - box.Left;
      body(std::int64_t{ row } * caster.GetWidth() + column, static_cast<std::size_t>(inTile));
    }
  }
}

}
