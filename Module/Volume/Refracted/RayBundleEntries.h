// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_RayBundleEntries_h
#define meniscus_Volume_Refracted_RayBundleEntries_h

#include "Simd/InstructionSets.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Whether cells are turned inside out by more than rounding: then a ray may come back to a cell,
 * and only a walk from the boundary on is sure to end on it.
 */
bool HasInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

/** The box about the boundary, in the frame of the view; without extent if there is none. */
BoundsInFrame BoxOf(const BoundaryTree& tree, const RayFrame& view);

/**
 * Which boundary faces straight lines of a frame enter by. Lines are taken in bundles: at a depth
 * all of a bundle are in a rectangle that changes linearly with it, which sifts the tree of the
 * boundary; the faces left are tested with every line by the signs and the tie rule of the walk.
 */
class RayBundleEntries
{
public:
  static constexpr int LargestBundle = 64;

  /** What `mesh`, `tree` and `frame` are must outlive this. */
  RayBundleEntries(const TetrahedralMesh& mesh, const BoundaryTree& tree,
    const RefractionFrame& frame, InstructionSet set);

  struct Line
  {
    FrameLine Of{};
    /** From which depth on entries are wanted. */
    double From = 0.0;
    PacketRay Ray{};
    /** Whether one of its entries is a face inside of the mesh: see FindEntryNear(). */
    bool EntersInside = false;
  };
  struct Hit
  {
    /** Number of the line. */
    std::int32_t Line;
    PacketEntry Entry;
  };
  /** Room for the work of one thread. */
  struct Workspace
  {
    std::vector<PacketFace> Faces;
    std::vector<std::uint64_t> Entered;
    std::vector<PacketRay> Rays;
  };

  /**
   * Appends the entries of lines, in no order.
   * @param numbers  of the lines of the bundle; at most LargestBundle.
   */
  void Collect(const std::vector<Line>& lines, const std::vector<std::int32_t>& numbers,
    Workspace& workspace, std::vector<Hit>& hits) const;

  /**
   * How a line enters the cell in front of a face, or one about it, before a depth: an entry from
   * which a walk comes to that depth. False if it passes by these cells.
   *
   * In a mesh without inverted cells the walk goes on to the boundary. Cells that rounding inverts
   * might make it go round for ever; the walk finds that out, and has to begin on the boundary.
   */
  bool FindEntryNear(
    std::int32_t cellFace, const PacketRay& ray, double before, PacketEntry& entry) const;

private:
  struct Bundle;
  void CollectFaces(const Bundle& bundle, std::vector<PacketFace>& faces) const;
  bool MayFace(const PacketFace& face, const Bundle& bundle) const;
  PacketFace SeenBy(const BoundaryFace& face) const;
  bool Enters(const PacketFace& face, const PacketRay& ray, double& depth) const;
  bool EntersCell(std::int64_t cell, const PacketRay& ray, double before, PacketEntry& entry) const;

  const TetrahedralMesh& Mesh;
  const BoundaryTree& Tree;
  const RefractionFrame& Frame;
  InstructionSet Set;
  /** Columns: normalised model coordinates to the frame, and the size of that. */
  glm::dmat3 ToFrame;
  glm::dmat3 Reach;
};

}

#endif
