// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_EntryRaster_h
#define meniscus_Volume_EntryRaster_h

#include "Volume/Packet/Packet.h"
#include "Volume/PixelRays.h"
#include "Volume/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Which boundary faces the rays of an image enter by, tile by tile.
 *
 * A face's edges are affine functions of the pixel. Where one is negative, or all are positive, by
 * more than rounding to the grid of (u, v) can change, that decides; else the signs are those that
 * the walk takes, exact and with its tie rule, so that each ray has as many entries as exits.
 */
class EntryRaster
{
public:
  static constexpr int TileSize = 32;

  /**
   * Sorts faces into tiles.
   * @param vertices  those of the mesh in the grid of the rays; must outlive this.
   * @param faces     the boundary that rays may enter by; must outlive this.
   */
  void Build(const std::vector<PacketVertex>& vertices, const std::vector<BoundaryFace>& faces,
    const PixelRays& rays);

  int GetNumberOfTiles() const { return this->Columns * this->Rows; }
  const PixelRays& GetRays() const { return this->Rays; }

  struct PixelBox
  {
    int Left;
    int Right; // exclusive
    int Bottom;
    int Top; // exclusive
  };
  PixelBox BoxOfTile(int tile) const;

  /** Least depth of the faces that a tile's rays may enter by; infinite without one. */
  double NearestDepth(int tile) const;

  struct Hit
  {
    /** In the tile: (row - Bottom) * TileSize + column - Left. */
    std::int32_t Pixel;
    PacketEntry Entry;
  };
  /** Entries of a tile's rays by pixel, then depth, then face. Replaces `hits`. */
  void CollectHits(int tile, std::vector<Hit>& hits) const;

private:
  /** u and v of a vertex as functions of the pixel: constant, per column, per row. */
  struct SeenVertex
  {
    glm::dvec3 U;
    glm::dvec3 V;
    double Depth;
  };
  struct SeenFace;

  SeenVertex See(std::int32_t vertex) const;
  SeenFace See(const BoundaryFace& face) const;
  PixelBox BoxOf(const SeenFace& face) const;
  bool EntersExactly(const SeenFace& face, const glm::ivec2& pixel, double (&areas)[3]) const;
  static double DepthAt(const SeenFace& face, const double (&areas)[3]);
  void CollectFace(
    const BoundaryFace& boundary, const PixelBox& tile, std::vector<Hit>& hits) const;

  const std::vector<PacketVertex>* Vertices = nullptr;
  const std::vector<BoundaryFace>* Faces = nullptr;
  PixelRays Rays;
  int Columns = 0;
  int Rows = 0;
  /** Faces of tile t: FaceOfSlot[TileBegin[t]] to [TileBegin[t + 1]]. */
  std::vector<std::int32_t> TileBegin;
  std::vector<std::int32_t> FaceOfSlot;
};

}

#endif
