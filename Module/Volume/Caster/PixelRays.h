// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Entries/BoundaryRaster.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * The several rays of pixels of a tile that are at edges. A pixel has a square of n x n rays, and
 * gets them in up to four rounds:
 * - at a low step, two rays on the diagonal along which the colour changes more;
 * - four rays, in different rows and columns where n is at least 4; pixels at high steps begin
 * here;
 * - four more, so that each row and column of four has two;
 * - all others.
 * It gets no further round if its k rays and that of the first image, through its centre, differ by
 * no more than k times the step that is tolerated: they find the covered part of the pixel in steps
 * of 1/k or less, so that they have the error of a single ray at the tolerated step. A pixel has
 * the mean colour of these rays, in which the centre counts 1.5 times between two others, and half
 * among more, or, if all have been cast, of its square.
 */
class PixelRays
{
public:
  static constexpr int TileSize = BoundaryRaster::TileSize;

  /**
   * Selects the first rays of each pixel.
   * @param rays box of the tile's rays in an image of rays, with whole pixels.
   * @param across number of rays n.
   * @param edges the code of each pixel's PixelEdge in the image of pixels.
   * @param width pixels of a row of this image.
   * @param level of edges that is tolerated: pixels up to this level get no rays.
   */
  void Begin(const BoundaryRaster::PixelBox& rays, int across, const std::uint8_t* edges,
    std::int64_t width, int level);
  /**
   * Selects further rays of the pixels that need them; returns false if there is none.
   * @param image premultiplied RGBA of the rays through the centres of the pixels.
   */
  bool SelectMore(const float* image);
  /** Writes the mean colours to the image that has the colours of the centres. */
  void Finish(float* image);

  /** Selected rays, as for BoundaryRaster. */
  const std::vector<std::int16_t>& GetSelected() const { return this->Selected; }
  /** Colours of the tile's rays, four numbers each, in rows of TileSize; 0 for selected rays. */
  float* GetColors() { return this->Colors.data(); }

private:
  enum class Round
  {
    Four,
    Eight,
    All,
    None
  };
  /** A pixel at an edge: its number in the image, and its first ray in the tile. */
  struct Pixel
  {
    std::int64_t InImage;
    int FirstRay;
    /** Rays of the square that are selected or have been cast. */
    int Rays;
    Round Next;
  };
  void BeginPixel(const Pixel& begun, std::uint8_t code, int level);
  void Select(Pixel& pixel, int row, int column);
  void SelectFour(Pixel& pixel, const int (&rows)[4]);
  void SelectNext(Pixel& pixel);
  float GetSquaredStep(const Pixel& pixel, const float* center) const;
  bool IsTolerated(const Pixel& pixel, float squaredStep) const;
  float WeightOfCenter(const Pixel& pixel) const;
  template <class Visit>
  void VisitRays(const Pixel& pixel, const Visit& visit) const;

  int Across = 1;
  float Tolerated = 0.0f;
  std::vector<Pixel> Pixels;
  /** Nonzero for each ray that is selected or has been cast. */
  std::vector<std::uint8_t> Known;
  std::vector<std::int16_t> Selected;
  std::vector<float> Colors;
};

}
