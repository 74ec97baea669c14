// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Entries/BoundaryRaster.h"

#include <cstddef>
#include <cstdint>

namespace meniscus
{

/** The rays of a tile along the Morton curve: rays next to each other are near each other. */
class TileCurve
{
public:
  static constexpr int TileSize = BoundaryRaster::TileSize;
  static_assert(TileSize == 32, "EvenBits() takes ten bits");

  constexpr TileCurve()
  {
    for (std::int32_t i = 0; i < TileSize * TileSize; ++i)
    {
      this->Numbers[i] = static_cast<std::int16_t>(EvenBits(i >> 1) * TileSize + EvenBits(i));
    }
  }

  /** Number of the ray at a place of the curve, in rows of TileSize. */
  constexpr std::int16_t operator[](std::size_t place) const { return this->Numbers[place]; }
  /** Places until the curve has passed the first `side` columns of as many rows. */
  static constexpr std::size_t LengthOf(int side)
  {
    std::size_t columns = 1;
    while (columns < static_cast<std::size_t>(side))
    {
      columns *= 2;
    }
    return columns * columns;
  }

private:
  /** Every second bit of a number of ten bits, as one number. */
  static constexpr std::int32_t EvenBits(std::int32_t number)
  {
    std::int32_t bits = 0;
    for (int i = 0; i < 5; ++i)
    {
      bits |= (number >> 2 * i & 1) << i;
    }
    return bits;
  }

  std::int16_t Numbers[TileSize * TileSize]{};
};

}
