// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Rays/RayFrame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Largest second difference of colours, in both directions together, between which rays are
 * interpolated, as a height (ColorChange). Where the colour is quadratic, interpolation errs by at
 * most 1/8 of it: a quarter of one of 255 levels. A crease or a step between two of three rays
 * changes the second difference of one of its sides by at least twice the error that it makes: that
 * is at most one level.
 */
constexpr float LargestInterpolatedDifference = 2.0f / 255.0f;

/**
 * Rays of a tile that are cast, and others whose colours are interpolated between them: adaptive
 * refinement of a picture (M. Levoy, "Volume rendering by adaptive refinement", The Visual Computer
 * 6, 1990).
 *
 * In each square with sides of FirstSide rays, 3 x 3 rays are cast first. Each of its quarters is
 * either interpolated or becomes a smaller square, which is treated likewise, down to rays next to
 * each other. The rays of a quarter are interpolated between its corners if
 * - the second differences along the sides of the quarter, over the square's three rays, are at
 *   most LargestInterpolatedDifference;
 * - all of its rays enter the mesh equally often: none of them passes a silhouette;
 * - all of its rays end at the same depth, or behind the mesh, by opaque geometry. Refracted rays
 *   do so if the window has the same depth everywhere.
 *
 * If the second differences are above four times that, all rays of the quarter are cast at once,
 * because each further round ends with packets that are not full. A detail that is smaller than a
 * quarter is not found if no cast ray meets it.
 */
class InterpolatedRays
{
public:
  static constexpr int TileSize = BoundaryRaster::TileSize;
  /** Side of the first squares; their rays are half of it apart. */
  static constexpr int FirstSide = 8;
  /** Number of the entries of each ray of a tile, in rows of TileSize. */
  using NumbersOfEntries = std::array<std::int32_t, std::size_t{ TileSize } * TileSize>;

  /** The rays of a tile. All objects must stay until they have been cast. */
  struct Tile
  {
    BoundaryRaster::PixelBox Box;
    const NumbersOfEntries* Entries;
    /** Frame of sight rays; null for refracted rays. */
    const RayFrame* Frame;
    /** Window depth of opaque geometry per pixel of the image; null for none. */
    const float* OpaqueDepth;
    /** Premultiplied RGBA per pixel of the image, 0 in the tile. */
    float* Image;
    /** Pixels of a row of the image. */
    std::int64_t Width;
  };

  /** Selects the first rays. */
  void Begin(const Tile& tile);
  /**
   * Interpolates rays between those that have been cast, where their colours differ little enough.
   * Selects further rays to cast elsewhere. Returns false if no ray is left to cast.
   */
  bool SelectMore();

  /** Selected rays, which enter the mesh, in rows of TileSize. */
  const std::vector<std::int16_t>& GetSelected() const { return this->Selected; }
  /** Rays that enter the mesh and were not selected. */
  std::int64_t GetNumberOfInterpolated() const;

private:
  /** Lower left ray of a square. */
  struct Square
  {
    int Column;
    int Row;
  };
  /** Three rays along one side of a square: two ends and the middle. */
  struct Three
  {
    int At[3];
    /** The first distance over the second one, which may be less at the tile's end; 0 for none. */
    float Ratio;
  };
  /** Rays from (Left, Bottom) to (Right, Top), which are included. */
  struct Quarter
  {
    int Left;
    int Right;
    int Bottom;
    int Top;
  };
  static std::size_t NumberOf(int column, int row)
  {
    return static_cast<std::size_t>(row) * TileSize + static_cast<std::size_t>(column);
  }
  std::int32_t EntriesOf(int column, int row) const
  {
    return (*this->Input.Entries)[NumberOf(column, row)];
  }
  std::int64_t PixelOf(int column, int row) const
  {
    return (this->Input.Box.Bottom + row) * this->Input.Width + this->Input.Box.Left + column;
  }
  float* ColorOf(int column, int row) const
  {
    return this->Input.Image + 4 * this->PixelOf(column, row);
  }
  Three Divide(int begin, int last) const;
  void Select(int column, int row);
  void SelectSquare(const Square& square);
  void SelectAll(const Quarter& quarter);
  void SetDifferences(const Three& columns, const Three& rows, float* across, float* along) const;
  bool HaveOneEnd(float depth, float other) const;
  bool AreAlike(const Quarter& quarter) const;
  void Interpolate(const Quarter& quarter);
  void Refine(const Square& square);

  Tile Input{};
  /** Last column and row of the tile. */
  int LastColumn = 0;
  int LastRow = 0;
  /** Side of the squares at hand, whose rays have been selected; 1 if there are none left. */
  int Side = 1;
  std::vector<Square> Squares;
  std::vector<Square> Next;
  /** Nonzero for rays that have been selected, or would have been if they entered the mesh. */
  std::vector<std::uint8_t> Known;
  std::vector<std::int16_t> Selected;
  std::int64_t NumberOfSelected = 0;
};

}
