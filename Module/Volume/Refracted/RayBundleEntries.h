// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/BoundsInFrame.h"
#include "Volume/Refracted/LineBlock.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace meniscus
{

/**
 * Bounding box of the boundary in the frame of the view; without extent if there is no boundary.
 */
BoundsInFrame BoxOf(const BoundaryTree& tree, const RayFrame& view);
/** Boxes around the parts of the boundary: up to `most`, the smallest that the tree has. */
std::vector<BoundsInFrame> PartsOf(
  const BoundaryTree& tree, const RayFrame& view, std::size_t most);

/**
 * Boundary faces by which straight lines of a frame enter the mesh. At each depth, all lines of a
 * bundle are in a rectangle that changes linearly with the depth. The tree of the boundary is
 * searched with the rectangles of all lines of a tile, and the faces that are found are tested with
 * the rectangles of its blocks. The remaining faces are tested with every line of a block by the
 * signs and the tie rule of the walk.
 */
class RayBundleEntries
{
public:
  /** `mesh`, `tree` and `frame` must outlive this object. */
  RayBundleEntries(const TetrahedralMesh& mesh, const BoundaryTree& tree,
    const RefractionFrame& frame, InstructionSet set);

  /** Bounds of up to 64 faces in the frame, widened by the rounding of vertices and rays. */
  struct FaceBlock
  {
    static constexpr int Size = 64;

    int Count = 0;
    /** Extents in x and y. */
    double Low[2][Size];
    double High[2][Size];
    /** Shares of the bundle's depths at which the face begins and ends. */
    double Nearest[Size];
    double Farthest[Size];
    /** Not 0 if a line of the latest block may enter by the face. */
    std::int64_t Meets[Size];
  };
  /** Buffers of one thread. */
  struct Workspace
  {
    /** Faces by which the lines of the bundle may enter, from near to far, and their bounds. */
    std::vector<PacketFace> Faces;
    std::vector<FaceBlock> Blocks;
    /**
     * The first NumberOfHits are the entries of the bundle's lines. Line i of block number b is ray
     * LineBlock::Size * b + i.
     */
    std::vector<PacketHit> Hits;
    std::size_t NumberOfHits = 0;
    /** Removes all entries. */
    void Clear()
    {
      this->Faces.clear();
      this->NumberOfHits = 0;
    }
    /** Adds an entry, with its face. */
    void Add(std::int32_t ray, const PacketEntry& entry);

    /** Nodes of the faces whose boxes lines of the bundle may meet. */
    std::vector<std::int32_t> Leaves;
    struct FoundFace
    {
      PacketFace Face;
      glm::dvec3 Center;
      glm::dvec3 Half;
    };
    std::vector<FoundFace> Found;
    /** Nearest depth and index of each face that was found. */
    std::vector<std::pair<float, std::int32_t>> Order;
    std::vector<PacketSpan> Spans;
  };

  /**
   * Sets the faces and the hits of the workspace to the entries of the lines of `count` blocks.
   * @param last depth behind which no entries are needed.
   */
  void Collect(const LineBlock* blocks, std::size_t count, Workspace& workspace,
    double last = std::numeric_limits<double>::infinity()) const;

  /**
   * Finds an entry of a line before a given depth into the cell at a face, or into a cell next to
   * it, from which a walk reaches that depth. Returns false if the line passes none of these cells.
   *
   * In a mesh without inverted cells the walk continues to the boundary. Cells that rounding
   * inverts might make it go round for ever; the walk detects this and has to begin on the boundary
   * instead.
   */
  bool FindEntryNear(
    std::int32_t cellFace, const PacketRay& ray, double before, PacketEntry& entry) const;

  /** Finds the face by which a line enters a cell before a given depth. False if there is none. */
  bool EntersCell(std::int64_t cell, const PacketRay& ray, double before, PacketEntry& entry) const;

private:
  struct Bundle;
  class BundlePlanes;
  Bundle Bound(const LineBlock* blocks, std::size_t count, double first, double last) const;
  void FindFaces(const Bundle& bundle, Workspace& workspace) const;
  void SortFaces(const Bundle& bundle, Workspace& workspace) const;
  bool MayFace(const PacketFace& face, const Bundle& bundle) const;
  void AddSpans(const Bundle& bundle, int lines, Workspace& workspace) const;
  void AddHits(const LineBlock& lines, std::int32_t firstRay, Workspace& workspace) const;
  bool Enters(const PacketFace& face, const PacketRay& ray, PacketEntry& entry) const;
  struct NearLine;
  NearLine LineNear(const std::array<std::int32_t, 4>& vertices, const PacketRay& ray) const;
  bool EntersFace(std::int64_t cell, int number, const NearLine& line, const PacketRay& ray,
    PacketEntry& entry) const;

  const TetrahedralMesh& Mesh;
  const BoundaryTree& Tree;
  const RefractionFrame& Frame;
  InstructionSet Set;
  /** Columns of the map from normalised model coordinates to the frame, and their magnitudes. */
  glm::dmat3 ToFrame;
  glm::dmat3 Reach;
};

}
