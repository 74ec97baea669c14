// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Entries_BoundaryRaster_h
#define meniscus_Volume_Entries_BoundaryRaster_h

#include "Volume/Entries/EntryLists.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/ProjectedFaces.h"

#include <cstdint>
#include <utility>
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
class BoundaryRaster
{
public:
  static constexpr int TileSize = 32;

  /**
   * Sorts faces into tiles.
   * @param vertices  those of the mesh in the grid of the rays; must outlive this.
   * @param faces     the boundary that rays may enter by; must outlive this.
   */
  void Build(const std::vector<PacketVertex>& vertices, const std::vector<BoundaryFace>& faces,
    const FixedPointRays& rays);

  int GetNumberOfTiles() const { return this->Columns * this->Rows; }
  const FixedPointRays& GetRays() const { return this->Faces.GetRays(); }

  using PixelBox = ProjectedFaces::PixelBox;
  PixelBox BoxOfTile(int tile) const;

  /** Least depth of the faces that a tile's rays may enter by; infinite without one. */
  double NearestDepth(int tile) const;

  /** Room for the work of one thread. */
  struct Workspace
  {
    /** Entries of the tile's rays, numbered (row - Bottom) * TileSize + column - Left. */
    EntryLists Lists;
    /** The tile's faces with their nearest depths. */
    std::vector<std::pair<float, std::int32_t>> Faces;
  };
  /** Replaces the lists of the workspace by the entries of a tile's rays. */
  void CollectEntries(int tile, Workspace& workspace) const;

private:
  bool EntersExactly(
    const ProjectedFaces::Face& face, const glm::ivec2& pixel, double (&areas)[3]) const;
  static double DepthAt(const ProjectedFaces::Face& face, const double (&areas)[3]);
  void CollectFace(std::int32_t index, const PixelBox& tile, EntryLists& lists) const;

  ProjectedFaces Faces;
  int Columns = 0;
  int Rows = 0;
  /** Pixels whose rays may enter by each face. */
  std::vector<PixelBox> Boxes;
  /** Faces of tile t: FaceOfSlot[TileBegin[t]] to [TileBegin[t + 1]]. */
  std::vector<std::int32_t> TileBegin;
  std::vector<std::int32_t> FaceOfSlot;
};

}

#endif
