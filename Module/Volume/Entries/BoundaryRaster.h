// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/GroupedItems.h"
#include "Common/RangeLoop.h"
#include "Simd/InstructionSets.h"
#include "Volume/Entries/EntryLists.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/ProjectedFaces.h"

#include <algorithm>
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

  /**
   * Sorts faces into tiles.
   * @param vertices vertices of the mesh in the grid of the rays; must outlive this object.
   * @param faces boundary by which rays may enter; must outlive this object.
   * @param loop runs over the faces, as the caller wants to.
   * @param pitch rays from a tile to the next one, at most TileSize.
   */
  void Build(const std::vector<PacketVertex>& vertices, const std::vector<BoundaryFace>& faces,
    const FixedPointRays& rays, const RangeLoop& loop = SerialLoop,
    InstructionSet set = BestInstructionSet(), int pitch = TileSize);

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

  /** Rays of a tile: those of each row between two columns, counted from the tile's corner. */
  struct TilePart
  {
    /** The first column of each row, and the one behind the last. */
    std::array<std::uint8_t, TileSize> First;
    std::array<std::uint8_t, TileSize> End;

    static TilePart Make(int first, int end)
    {
      TilePart part;
      part.First.fill(static_cast<std::uint8_t>(first));
      part.End.fill(static_cast<std::uint8_t>(end));
      return part;
    }
    static TilePart Whole() { return Make(0, TileSize); }
    static TilePart Nothing() { return Make(TileSize, 0); }
    /** Adds columns of a row, and those between them and others of the row. */
    void Add(int row, int first, int end)
    {
      const auto r = static_cast<std::size_t>(row);
      this->First[r] = std::min(this->First[r], static_cast<std::uint8_t>(first));
      this->End[r] = std::max(this->End[r], static_cast<std::uint8_t>(end));
    }
  };

  /** Buffers of one thread. */
  struct Workspace
  {
    /** Entries of the tile's rays, which are numbered (row - Bottom) * TileSize + column - Left. */
    EntryLists Lists;
    /** The tile's faces with their nearest depths, from near to far. */
    std::vector<std::pair<float, std::int32_t>> Order;
    std::vector<PacketFace> Faces;
    /** Pixels that each face may cover, row by row, and the number of these pixels. */
    std::vector<PacketSpan> Spans;
    std::size_t SpannedPixels = 0;
    std::vector<PacketHit> Hits;
    /** Lines of the tile's rays: SizeOfRays numbers each in x, then in y. */
    std::vector<std::int32_t> Offsets;
    std::vector<float> Slopes;
    /** 0 unless rays are fine. */
    std::vector<float> Fractions;
    std::vector<float> SlopeRests;
  };
  /** Sets the line of a ray as in the tile whose entries were collected last. */
  static void SetLine(const Workspace& workspace, std::size_t pixel, PacketRay& ray)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const std::size_t at = axis * SizeOfRays + pixel;
      ray.Offset[axis] = workspace.Offsets[at];
      ray.Slope[axis] = workspace.Slopes[at];
      ray.Fraction[axis] = workspace.Fractions[at];
      ray.SlopeRest[axis] = workspace.SlopeRests[at];
    }
  }
  /**
   * Replaces the lists of the workspace by the entries of a tile's rays.
   * @param wanted rays outside of this part get no entries.
   */
  void CollectEntries(int tile, const TilePart& wanted, Workspace& workspace) const;
  void CollectEntries(int tile, Workspace& workspace) const
  {
    this->CollectEntries(tile, TilePart::Whole(), workspace);
  }

private:
  void FillRays(
    const PixelBox& tile, const TilePart& wanted, const PixelBox& box, Workspace& workspace) const;
  PixelBox AddSpans(
    std::int32_t index, const PixelBox& tile, const TilePart& wanted, Workspace& workspace) const;

  /** Readable length of each row of the tile's lines (PacketSpanJob). */
  static constexpr int SizeOfRays = TileSize * TileSize + 16;

  ProjectedFaces Faces;
  InstructionSet Set = InstructionSet::Portable;
  int Pitch = TileSize;
  int Columns = 0;
  int Rows = 0;
  /** Pixels whose rays may enter by each face. */
  std::vector<PixelBox> Boxes;
  GroupedItems FacesOfTiles;
};

}
