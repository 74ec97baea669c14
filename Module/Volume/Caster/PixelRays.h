// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_PixelRays_h
#define meniscus_Volume_Caster_PixelRays_h

#include "Volume/Entries/BoundaryRaster.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * The several rays of selected pixels of a tile. A pixel has a square of n x n rays. Four of them,
 * in different rows and columns where n is at least 4, are cast first. If they and the ray through
 * the pixel's centre agree within FewRaysThreshold, the pixel gets the mean of the four; otherwise
 * the others are cast, too, and it gets the mean of all of them.
 */
class PixelRays
{
public:
  static constexpr int TileSize = BoundaryRaster::TileSize;

  /**
   * Selects the first four rays of each pixel.
   * @param rays box of the tile's rays in an image of rays, with whole pixels.
   * @param across number of rays n.
   * @param selected nonzero for each pixel of the image of pixels that is selected.
   * @param width pixels of a row of this image.
   */
  void Begin(const BoundaryRaster::PixelBox& rays, int across, const std::uint8_t* selected,
    std::int64_t width);
  /**
   * Selects the other rays of the pixels that need them; returns false if there is none.
   * @param image premultiplied RGBA of the rays through the centres of the pixels.
   */
  bool SelectOthers(const float* image);
  /** Writes the mean colours to the image. */
  void Finish(float* image);

  /** Nonzero for each selected ray, in rows of TileSize; and the box that contains them. */
  const std::uint8_t* GetSelected() const { return this->Selected.data(); }
  const BoundaryRaster::PixelBox& GetWanted() const { return this->Wanted; }
  /** Colours of the tile's rays, four numbers each, in rows of TileSize; 0 to begin with. */
  float* GetColors() { return this->Colors.data(); }

private:
  /** A selected pixel: its number in the image, and its first ray in the tile. */
  struct Pixel
  {
    std::int64_t InImage;
    int FirstRay;
    bool HasAll;
  };
  bool FirstRaysAgree(const Pixel& pixel, const float* center) const;

  int Across = 1;
  /** The first four rays of a pixel, counted from its lower left ray. */
  std::array<int, 4> FirstRays{};
  std::vector<Pixel> Pixels;
  std::vector<std::uint8_t> Selected;
  BoundaryRaster::PixelBox Wanted{ 0, 0, 0, 0 };
  std::vector<float> Colors;
};

}

#endif
