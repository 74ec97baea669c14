// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_RayBundleEntries_h
#define meniscus_Volume_Refracted_RayBundleEntries_h

#include "Simd/InstructionSets.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * True if a cell is inverted by more than rounding. A ray may then return to a cell it has left,
 * and only a walk from the boundary is certain to end on the boundary.
 */
bool HasInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

/**
 * Bounding box of the boundary in the frame of the view; without extent if there is no boundary.
 */
BoundsInFrame BoxOf(const BoundaryTree& tree, const RayFrame& view);

/**
 * Boundary faces by which straight lines of a frame enter the mesh. Lines are taken in bundles: at
 * each depth, all lines of a bundle are in a rectangle that changes linearly with the depth, and
 * the tree of the boundary is searched with these rectangles. The remaining faces are tested with
 * every line by the signs and the tie rule of the walk.
 */
class RayBundleEntries
{
public:
  static constexpr int LargestBundle = 64;

  /** `mesh`, `tree` and `frame` must outlive this object. */
  RayBundleEntries(const TetrahedralMesh& mesh, const BoundaryTree& tree,
    const RefractionFrame& frame, InstructionSet set);

  struct Line
  {
    FrameLine Of{};
    /** Depth from which on entries are collected. */
    double From = 0.0;
    PacketRay Ray{};
    /** True if one of its entries is a face inside the mesh: see FindEntryNear(). */
    bool EntersInside = false;
  };
  struct Hit
  {
    /** Index of the line. */
    std::int32_t Line;
    PacketEntry Entry;
  };
  /** Buffers of one thread. */
  struct Workspace
  {
    std::vector<PacketFace> Faces;
    std::vector<std::uint64_t> Entered;
    std::vector<PacketRay> Rays;
  };

  /**
   * Appends the entries of lines, unsorted.
   * @param numbers indices of the lines of the bundle; at most LargestBundle.
   */
  void Collect(const std::vector<Line>& lines, const std::vector<std::int32_t>& numbers,
    Workspace& workspace, std::vector<Hit>& hits) const;

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

private:
  struct Bundle;
  void CollectFaces(const Bundle& bundle, std::vector<PacketFace>& faces) const;
  bool MayFace(const PacketFace& face, const Bundle& bundle) const;
  PacketFace SeenBy(const BoundaryFace& face) const;
  bool Enters(const PacketFace& face, const PacketRay& ray, PacketEntry& entry) const;
  bool EntersCell(std::int64_t cell, const PacketRay& ray, double before, PacketEntry& entry) const;

  const TetrahedralMesh& Mesh;
  const BoundaryTree& Tree;
  const RefractionFrame& Frame;
  InstructionSet Set;
  /** Columns of the map from normalised model coordinates to the frame, and their magnitudes. */
  glm::dmat3 ToFrame;
  glm::dmat3 Reach;
};

}

#endif
