// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/GroupedItems.h"
#include "Common/RangeLoop.h"
#include "Simd/InstructionSets.h"
#include "Volume/Entries/EntryLists.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/ProjectedFaces.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace meniscus
{

/**
 * Boundary faces by which the rays of an image enter the mesh, tile by tile.
 *
 * The edges of a face are affine functions of the pixel. Pixels for which one is negative by more
 * than the rounding of coordinates about rays can change are left out; for the others, the exact
 * signs of the walk decide, with its rule for ties, so that each ray has as many entries as exits.
 */
class BoundaryRaster
{
public:
  static constexpr int TileSize = 32;

  /** An image with several times the columns and rows of another one of the same view. */
  struct Refinement
  {
    /** Raster of the same vertices and faces for the other image; null if there is none. */
    const BoundaryRaster* Coarse;
    /** Nonzero for each tile whose entries will be collected; null for all tiles. */
    const std::vector<std::uint8_t>* Tiles;
  };

  /**
   * Sorts faces into tiles.
   * @param vertices vertices of the mesh in the grid of the rays; must outlive this object.
   * @param faces boundary by which rays may enter; must outlive this object.
   * @param loop runs over the faces, as the caller wants to.
   * @param pitch rays from a tile to the next one, at most TileSize.
   * @param refinement spares most of the work, where a part of a refined image is cast only.
   */
  void Build(const std::vector<PacketVertex>& vertices, const std::vector<BoundaryFace>& faces,
    const FixedPointRays& rays, const RangeLoop& loop = SerialLoop,
    InstructionSet set = BestInstructionSet(), int pitch = TileSize,
    const Refinement& refinement = { nullptr, nullptr });

  int GetNumberOfTiles() const { return this->Columns * this->Rows; }
  const FixedPointRays& GetRays() const { return this->Faces.GetRays(); }

  using PixelBox = ProjectedFaces::PixelBox;
  PixelBox BoxOfTile(int tile) const;

  /** True if no ray of the tile enters the mesh. */
  bool IsEmpty(int tile) const
  {
    return this->FacesOfTiles.IsEmpty(static_cast<std::size_t>(tile));
  }
  /** Smallest depth of the faces by which rays of a tile may enter; infinite if there is none. */
  double NearestDepth(int tile) const;

  /** Buffers of one thread. */
  struct Workspace
  {
    EntryLists Lists;
    /** The tile's faces with their nearest depths, from near to far. */
    std::vector<std::pair<float, std::int32_t>> Order;
    std::vector<PacketFace> Faces;
    /** Rays that may enter by each face, and their number. */
    std::vector<PacketSpan> Spans;
    std::size_t SpannedRays = 0;
    std::vector<PacketHit> Hits;
    /** Boxes of the groups of selected rays. */
    std::vector<PixelBox> Groups;
    /** Lines of the lists' rays: SizeOfRays numbers each in x, then in y. */
    std::vector<std::int32_t> Offsets;
    std::vector<float> Slopes;
    /** 0 unless rays are fine. */
    std::vector<float> Fractions;
    std::vector<float> SlopeRests;

    void AddSpan(std::int32_t face, std::int32_t first, std::int32_t end)
    {
      this->Spans.push_back({ face, first, end });
      this->SpannedRays += static_cast<std::size_t>(end - first);
    }
  };
  /** Sets the line of a ray of the lists that were collected last. */
  static void SetLine(const Workspace& workspace, std::size_t number, PacketRay& ray)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const std::size_t at = axis * SizeOfRays + number;
      ray.Offset[axis] = workspace.Offsets[at];
      ray.Slope[axis] = workspace.Slopes[at];
      ray.Fraction[axis] = workspace.Fractions[at];
      ray.SlopeRest[axis] = workspace.SlopeRests[at];
    }
  }
  /**
   * Replaces the lists of the workspace by the entries of all rays of a tile, which are numbered
   * (row - Bottom) * TileSize + column - Left.
   */
  void CollectEntries(int tile, Workspace& workspace) const;
  /**
   * Replaces the lists of the workspace by the entries of some of a tile's rays.
   * @param rays their numbers among all rays, each once. The lists have the rays in this order; it
   *   is best if those next to each other are near each other.
   */
  void CollectEntries(int tile, const std::vector<std::int16_t>& rays, Workspace& workspace) const;

private:
  /** Corners of a rectangle in pixels about the image's centre, rounded outwards. */
  struct Extent
  {
    std::array<float, 2> Lower;
    std::array<float, 2> Upper;
  };

  void BoundFaces(const BoundaryRaster* coarse, const RangeLoop& loop);
  void ListFaces(int tile, const PixelBox& part, Workspace& workspace) const;
  void FillRays(const PixelBox& tile, const PixelBox& box, Workspace& workspace) const;
  PixelBox AddSpans(std::int32_t index, const PixelBox& tile, Workspace& workspace) const;
  static PixelBox GroupRays(
    const PixelBox& tile, const std::vector<std::int16_t>& rays, Workspace& workspace);
  void AddGroups(std::int32_t index, std::size_t rays, Workspace& workspace) const;
  void PrepareLines(Workspace& workspace) const;
  static FixedPointRays::RowOfRays LinesFrom(int number, Workspace& workspace);
  void TestSpans(std::size_t rays, Workspace& workspace) const;

  /** Readable length of each row of the tile's lines (PacketSpanJob). */
  static constexpr int SizeOfRays = TileSize * TileSize + 16;

  ProjectedFaces Faces;
  InstructionSet Set = InstructionSet::Portable;
  int Pitch = TileSize;
  int Columns = 0;
  int Rows = 0;
  /** Pixels whose rays may enter by each face. */
  std::vector<PixelBox> Boxes;
  /** Footprints of the faces. */
  std::vector<Extent> Extents;
  GroupedItems FacesOfTiles;
};

}
