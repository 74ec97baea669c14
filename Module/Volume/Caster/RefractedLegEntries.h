// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Caster/InterpolatedRays.h"
#include "Volume/Caster/JoinedRays.h"
#include "Volume/Caster/LegBatch.h"
#include "Volume/Caster/LegFrame.h"
#include "Volume/Entries/EntryLists.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Refracted/LegBlock.h"
#include "Volume/Refracted/LegBox.h"
#include "Volume/Refracted/LineBlock.h"
#include "Volume/Refracted/RayBundleEntries.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus
{

/** Refraction of the rays of an image; RayCastMembrane creates it. */
struct RefractedScene
{
  /** Rays behind each interface, in the order in which rays meet them: legs 1 and following. */
  std::vector<const RefractedRayTiles*> Legs{};
  /** Frames of these legs, with the vertices placed. */
  const RefractionFrames* Frames = nullptr;
  /** Tree over the boundary by which rays enter. */
  const BoundaryTree* Tree = nullptr;
  /**
   * True if a leg may begin in the cell that contains the sight point; otherwise it begins on the
   * boundary.
   */
  bool BeginsInside = false;
  /** Legs that are drawn. */
  LegRange Drawn{};
};

/**
 * Refracted legs of the rays of an image, from leg 1 on. They are in the frames of the refraction.
 * Legs are set up for squares of pixels at once, and their entries are found by bundles of rays.
 */
class RefractedLegEntries
{
public:
  static constexpr int NumberOfFrames = RefractionFrames::Number;

  /**
   * All objects that the arguments refer to must outlive this object.
   * @param rays sight rays of the image.
   * @param optics optics in the frame of the view.
   */
  RefractedLegEntries(const RefractedScene& scene, const TetrahedralMesh& mesh,
    const FixedPointRays& rays, const std::vector<RayClippingPlane>& clippingPlanes,
    const RayLegs& legs, const FrameOptics& optics, InstructionSet set);

  const LegFrame& GetFrame(int frame) const { return this->Cast[static_cast<std::size_t>(frame)]; }
  /** As SightLegEntries; the depth of the leg's sight point. */
  double GetBeginDepth(int frame, const RayLeg& leg, double) const
  {
    const RefractionFrame& turned = this->Scene.Frames->Get(frame);
    return (turned.FromView * leg.Begin).z * FixedPointRays::GridPerDepth - turned.Rays.GetPivot();
  }

  /** As SightLegEntries. */
  double GetStepsPerDepth(int frame, const RayLeg& leg) const
  {
    const glm::dmat3& turn = this->Scene.Frames->Get(frame).FromView;
    return 1.0 / ((turn * leg.Step).z * FixedPointRays::GridPerDepth);
  }

  /** Buffers of one thread. */
  struct Workspace
  {
    /** Lines of the tile in one frame that are cast together. */
    struct Group
    {
      /** The first NumberOfBlocks are in use. */
      std::vector<LineBlock> Blocks;
      std::size_t NumberOfBlocks = 0;
      /** Entries of the lines, once they have been found. */
      EntryLists Entries;
      bool HasEntries = false;
      /** True once the group was in a batch, since the lines to be cast were chosen. */
      bool IsTaken = false;
      /** LineBlock::Size per block. */
      std::vector<LegBatch::Origin> Origins;
      /** Lines that enter by a face inside the mesh, which is not among their other entries. */
      struct Inside
      {
        /** LineBlock::Size * block + line. */
        std::int32_t Line;
        PacketEntry Entry;
      };
      std::vector<Inside> EntriesInside;

      void Clear();
      LineBlock& AddBlock();
    };
    /**
     * Groups of a frame: lines whose start is known to be inside or outside of the mesh, all
     * others, and lines that began inside and did not reach the boundary.
     */
    enum : unsigned int
    {
      Known,
      Unknown,
      Again,
      NumberOfGroups
    };
    std::array<std::array<Group, NumberOfGroups>, NumberOfFrames> Frames;

    /** Legs of a square of the tile, and its legs in one group. */
    LegBlock Legs;
    LegBlock Chosen;
    /**
     * For each leg of the square: the pixel, the place where the leg before ended
     * (PacketResult::End), the group as NumberOfGroups * frame + kind, and whether the leg enters
     * by a face inside the mesh.
     */
    std::array<LegBatch::Origin, LegBlock::Size> Origins;
    std::array<std::int32_t, LegBlock::Size> Ends;
    std::array<unsigned int, LegBlock::Size> Groups;
    std::array<bool, LegBlock::Size> IsInside;
    std::array<PacketEntry, LegBlock::Size> EntriesInside;

    RayBundleEntries::Workspace Faces;
    /** False for rays of the tile whose lines are not cast now; TileLeg::Selected. */
    std::array<bool, RefractedRayTiles::RaysOfTile> IsSelected;
    LegBatch Batch;
    /** Kind of the batch's group, and the line of each of its rays. */
    unsigned int BatchKind = 0;
    std::vector<std::int32_t> Lines;
  };

  /**
   * Finds the lines of a leg of a tile, unless they are listed (TileLeg::IsListed), and chooses
   * those that are cast.
   * @param joined rays up to this leg; gets the ends of lines that are not cast.
   */
  void Collect(
    const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const;
  /** Finds the entries of all lines that were collected, and adds their numbers by ray. */
  void CountEntries(Workspace& workspace, InterpolatedRays::NumbersOfEntries& numbers) const;
  /** Lines in a frame that remain to be cast; null if there are none. */
  const LegBatch* NextBatch(int frame, Workspace& workspace) const;
  /**
   * True if a lost line of the last batch is to be cast again, from the boundary: a line whose walk
   * began inside the mesh.
   * @param ray index of the line in the batch.
   */
  bool TakeBack(int frame, std::size_t ray, Workspace& workspace) const;

private:
  void FindLines(
    const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const;
  void SiftLegs(
    const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const;
  void SetParts(const TileLeg& leg, LegBlock& legs) const;
  bool FindEntryInside(const LegBlock& legs, int ray, std::int32_t end, PacketEntry& entry) const;
  void GroupLegs(Workspace& workspace) const;
  void AddToGroup(unsigned int number, LegBlock& chosen, Workspace& workspace) const;
  void FindEntries(int frame, Workspace::Group& group, Workspace& workspace) const;
  void SetBatch(int frame, Workspace::Group& group, Workspace& workspace) const;

  RefractedScene Scene;
  /** Box about the boundary of the mesh, in the frame of the view. */
  LegBox Box;
  const FixedPointRays& Rays;
  const std::vector<RayClippingPlane>& ClippingPlanes;
  const RayLegs& Legs;
  InstructionSet Set;
  std::vector<RayBundleEntries> Entries;
  std::array<LegFrame, RefractionFrames::Number> Cast;
};

}
