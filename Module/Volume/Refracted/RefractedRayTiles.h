// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/**
 * Refraction of one pixel's ray at an interface, in the frame of the view. Points of a ray are
 * given by the depths at which they are drawn: their own depths in front of the first interface,
 * and behind an interface the depth of the sight point there plus the distance in units of Step.
 */
struct RefractedRay
{
  /** Drawn depth of the sight point; infinite if the ray does not meet the interface. */
  double Depth = std::numeric_limits<double>::infinity();
  /**
   * Step along the refracted ray per unit of drawn depth: the point drawn at the depth Depth + s is
   * the sight point + s * Step (the inverse of the thesis's Eq. 2.4). It is 0 if the ray is totally
   * reflected.
   */
  glm::dvec3 Step{ 0.0 };

  bool MeetsInterface() const { return this->Depth < std::numeric_limits<double>::infinity(); }
  bool GoesOn() const { return this->Step != glm::dvec3(0.0); }
};

/** Squares of a tile: a bit for each, row by row. */
using TileSquares = std::uint16_t;

/** The rays of an image behind one refracting interface, by tiles. */
class RefractedRayTiles
{
public:
  static constexpr int TileSize = 32;
  static constexpr int RaysOfTile = TileSize * TileSize;
  /** Side length, in pixels, of the squares of a tile; see LegBlock. */
  static constexpr int SquareSize = 8;
  static constexpr int SquaresOfRow = TileSize / SquareSize;
  static constexpr int SquaresOfTile = SquaresOfRow * SquaresOfRow;
  static constexpr TileSquares AllSquares = 0xFFFF;
  static_assert(SquaresOfTile == 16, "TileSquares has a bit per square");

  /** First pixel of a square, from the tile's. */
  static int ColumnOfSquare(int square) { return square % SquaresOfRow * SquareSize; }
  static int RowOfSquare(int square) { return square / SquaresOfRow * SquareSize; }
  /** The square of a pixel, numbered in rows of TileSize, as a bit. */
  static TileSquares SquareOf(int pixel)
  {
    const int column = pixel % TileSize / SquareSize;
    const int row = pixel / TileSize / SquareSize;
    return static_cast<TileSquares>(1u << (row * SquaresOfRow + column));
  }

  /** Sets the number of tiles, and keeps the rays of those that there were. */
  void Resize(std::size_t tiles)
  {
    this->Tiles.resize(tiles);
    this->GoingOn.resize(tiles, AllSquares);
    this->Showing.resize(tiles, AllSquares);
    this->Farthest.resize(tiles, std::numeric_limits<double>::infinity());
  }
  /** Removes all tiles. */
  void Clear() { this->Resize(0); }

  int GetNumberOfTiles() const { return static_cast<int>(this->Tiles.size()); }
  /**
   * Rays of a tile in rows of TileSize, starting at the tile's lower left pixel; null if no ray of
   * the tile meets the interface. Tiles are numbered as in BoundaryRaster.
   */
  const RefractedRay* GetTile(int tile) const
  {
    const auto& rays = this->Tiles[static_cast<std::size_t>(tile)];
    return rays.empty() ? nullptr : rays.data();
  }
  /** Rays of a tile, to be changed: RaysOfTile, or none. */
  std::vector<RefractedRay>& ChangeTile(int tile)
  {
    return this->Tiles[static_cast<std::size_t>(tile)];
  }
  /**
   * Sets the squares of a tile in which a ray goes on behind the interface, and the squares in
   * which the leg behind it may meet the mesh. A new tile has all squares in both.
   */
  void SetSquares(int tile, TileSquares goingOn, TileSquares showing)
  {
    this->GoingOn[static_cast<std::size_t>(tile)] = goingOn;
    this->Showing[static_cast<std::size_t>(tile)] = showing;
  }
  /** Adds a square to them. */
  void AddSquare(int tile, int square, bool goesOn, bool mayShow)
  {
    const auto at = static_cast<std::size_t>(tile);
    this->GoingOn[at] = static_cast<TileSquares>(this->GoingOn[at] | (goesOn ? 1u : 0u) << square);
    this->Showing[at] = static_cast<TileSquares>(this->Showing[at] | (mayShow ? 1u : 0u) << square);
  }
  /**
   * Sets a bound of the depths at which those rays of a tile meet the interface that may come to
   * the mesh before; infinite, as in a new tile, if one of them passes the interface.
   */
  void SetFarthest(int tile, double depth)
  {
    this->Farthest[static_cast<std::size_t>(tile)] = depth;
  }
  double GetFarthest(int tile) const { return this->Farthest[static_cast<std::size_t>(tile)]; }
  bool GoesOn(int tile, int square) const
  {
    return (this->GoingOn[static_cast<std::size_t>(tile)] >> square & 1u) != 0;
  }
  bool MayShow(int tile) const { return this->Showing[static_cast<std::size_t>(tile)] != 0; }
  bool MayShow(int tile, int square) const
  {
    return (this->Showing[static_cast<std::size_t>(tile)] >> square & 1u) != 0;
  }
  /** True if any ray meets the interface. */
  bool HasRays() const
  {
    return std::any_of(this->Tiles.begin(), this->Tiles.end(),
      [](const std::vector<RefractedRay>& tile) { return !tile.empty(); });
  }
  std::int64_t GetBytes() const
  {
    std::size_t rays = 0;
    for (const std::vector<RefractedRay>& tile : this->Tiles)
    {
      rays += tile.capacity();
    }
    return static_cast<std::int64_t>(rays * sizeof(RefractedRay));
  }

private:
  std::vector<std::vector<RefractedRay>> Tiles;
  std::vector<TileSquares> GoingOn;
  std::vector<TileSquares> Showing;
  std::vector<double> Farthest;
};

}
