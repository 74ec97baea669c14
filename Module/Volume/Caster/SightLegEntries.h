// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Caster/JoinedRays.h"
#include "Volume/Caster/LegBatch.h"
#include "Volume/Caster/LegFrame.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Rays/BoundsInFrame.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Refracted/RayLegs.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Leg 0 of the rays of an image: the sight rays, up to the first interface. They are in the image's
 * own frame, and their entries come from the raster of the boundary.
 */
class SightLegEntries
{
public:
  static constexpr int NumberOfFrames = 1;

  /**
   * All objects that the arguments refer to must outlive this object.
   * @param tree tree over the boundary; may be null if there are no further legs.
   * @param pitch rays from a tile to the next one, as in `legs`.
   * @param refinement as for BoundaryRaster.
   */
  SightLegEntries(const FixedPointRays& rays, const std::vector<PacketVertex>& vertices,
    const std::vector<BoundaryFace>& boundary, const BoundaryTree* tree,
    const std::vector<RayClippingPlane>& clippingPlanes, const RayLegs& legs,
    const FrameOptics& optics, InstructionSet set, const RangeLoop& loop, int pitch,
    const BoundaryRaster::Refinement& refinement);

  const BoundaryRaster& GetRaster() const { return this->Raster; }
  const LegFrame& GetFrame(int) const { return this->Frame; }
  /** False if no sight ray of a tile comes to the mesh before the first interface. */
  bool MayShow(int tile) const;
  /**
   * Depth from which distances along a leg count, in grid units from the pivot of the leg's frame:
   * of leg 0, the given depth.
   */
  double GetBeginDepth(int, const RayLeg&, double depth) const
  {
    return depth * FixedPointRays::GridPerDepth - this->Rays.GetPivot();
  }

  /** Steps of a leg (RayLeg::Step) per grid unit of its frame's depth. */
  double GetStepsPerDepth(int, const RayLeg&) const { return 1.0 / FixedPointRays::GridPerDepth; }

  /** Buffers of one thread. */
  struct Workspace
  {
    BoundaryRaster::Workspace Raster;
    LegBatch Batch;
    bool IsTaken = false;
  };

  /** Finds the lines of a leg of a tile. @param joined gets the ends of lines that are not cast. */
  void Collect(
    const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const;
  /** Lines in a frame that remain to be cast; null if there are none. */
  const LegBatch* NextBatch(int frame, Workspace& workspace) const;
  /** True if a lost line of the last batch is to be cast again. */
  bool TakeBack(int, std::size_t, Workspace&) const { return false; }

private:
  void Limit(int column, int row, double end, PacketRay& ray) const;
  bool EndBefore(const BoundsInFrame& mesh) const;
  bool ReachDepth(int tile, double depth) const;
  std::int64_t PixelOf(const TileLeg& leg, int column, int row) const;
  void TakeRays(
    const TileLeg& leg, const RefractedRay* next, JoinedRays& joined, Workspace& workspace) const;

  const FixedPointRays& Rays;
  const std::vector<RayClippingPlane>& ClippingPlanes;
  const RayLegs& Legs;
  BoundaryRaster Raster;
  LegFrame Frame;
};

}
