// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_RefractedLegEntries_h
#define meniscus_Volume_Caster_RefractedLegEntries_h

#include "Simd/InstructionSets.h"
#include "Volume/Caster/JoinedRays.h"
#include "Volume/Caster/LegBatch.h"
#include "Volume/Caster/LegFrame.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/FixedPointRays.h"
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
 * Refracted legs of the rays of an image, from leg 1 on. They are in the frames of the refraction,
 * and their entries are found by bundles of rays.
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
    struct OfFrame
    {
      std::vector<RayBundleEntries::Line> Lines;
      /** One per line. */
      std::vector<LegBatch::Origin> Origins;
      std::vector<RayBundleEntries::Hit> Hits;
      /**
       * Lines of the current block whose start is known to be outside of the mesh, and all others.
       */
      std::vector<std::int32_t> Bundles[2];
      /** Lines that began inside and did not reach the boundary. */
      std::vector<std::int32_t> RetryLines;
    };
    std::array<OfFrame, RefractionFrames::Number> Frames;
    RayBundleEntries::Workspace Faces;
    LegBatch Batch;
    /** Index of the line of each ray of the batch. */
    std::vector<std::int32_t> Lines;
    std::vector<PacketEntry> Entries;
  };

  /**
   * Finds the lines of a leg of a tile.
   * @param joined rays up to this leg; gets the ends of lines that are not cast.
   */
  void Collect(
    const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const;
  /** Lines in a frame that remain to be cast; null if there are none. */
  const LegBatch* NextBatch(int frame, Workspace& workspace) const;
  /**
   * True if a lost line of the last batch is to be cast again, from the boundary: a line whose walk
   * began inside the mesh.
   * @param ray index of the line in the batch.
   */
  bool TakeBack(int frame, std::size_t ray, Workspace& workspace) const;

private:
  struct Part;
  bool FindPart(const TileLeg& leg, std::int32_t pixel, const RayLeg& line, Part& part) const;
  bool MayMeetMesh(const RayLeg& line) const;
  bool IsBesideMesh(const RayLeg& line) const;
  void AddLine(const RayLeg& line, const Part& part, std::int32_t pixel, std::int32_t end,
    Workspace& workspace) const;
  void CollectPixel(const TileLeg& leg, const PacketJob& job, std::int32_t pixel,
    JoinedRays& joined, Workspace& workspace) const;
  void CollectBlock(Workspace& workspace) const;
  void CollectAgain(int frame, Workspace& workspace) const;

  RefractedScene Scene;
  /** Bounding box and bounding sphere of the mesh's boundary, in the frame of the view. */
  BoundsInFrame Box;
  double BallRadius = 0.0;
  /** Normals of the box's sides, cross products of two edges, and their products with the third. */
  glm::dvec3 Areas[3];
  double Extents[3];
  const FixedPointRays& Rays;
  const std::vector<RayClippingPlane>& ClippingPlanes;
  const RayLegs& Legs;
  std::vector<RayBundleEntries> Entries;
  std::array<LegFrame, RefractionFrames::Number> Cast;
};

}

#endif
