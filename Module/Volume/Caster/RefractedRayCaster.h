// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_RefractedRayCaster_h
#define meniscus_Volume_Caster_RefractedRayCaster_h

#include "Simd/InstructionSets.h"
#include "Volume/Caster/GradientShadingTable.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/RayStatistics.h"
#include "Volume/Refracted/RayBundleEntries.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <array>
#include <vector>

namespace meniscus
{

/** Refraction of the rays of an image at a membrane; RayCastMembrane creates it. */
struct RefractedScene
{
  const RefractedRayField* Sight = nullptr;
  /** Frames with the vertices placed. */
  const RefractionFrames* Frames = nullptr;
  /** Tree over the boundary by which rays enter. */
  const BoundaryTree* Tree = nullptr;
  /**
   * True if a refracted ray may begin in the cell that contains the sight point; otherwise it
   * begins on the boundary.
   */
  bool BeginsInside = false;
  MembranePart Part = MembranePart::Whole;
};

/**
 * Optics that depend on the frame of the rays, given in the frame of the view; see
 * GradientShadingTable::Pack().
 */
struct RefractedOptics
{
  const SurfaceLighting* Lighting;
  glm::dmat3 GradientToFrame;
  double GradientMagnitude;
  const std::vector<PacketInterval>* GradientOpacity;
};

/** Results of the straight rays of a tile, up to the membrane. */
struct StraightPart
{
  /**
   * Values and End of PacketResult, by pixel of the tile in rows of RefractedRayField::TileSize.
   */
  std::vector<std::array<float, 4>> Values;
  std::vector<std::int32_t> Ends;
  /** Number of cells crossed so far. */
  std::vector<std::int32_t> Steps;

  /** @param end value of PacketResult::End for rays without a result. */
  void Clear(BlendMode mode, std::int32_t end);
};

/**
 * Casts the refracted rays of a tile and joins their results with those of the straight rays in
 * front of the membrane.
 */
class RefractedRayCaster
{
public:
  /** All objects that the arguments refer to must outlive this object. */
  RefractedRayCaster(const RefractedScene& scene, const TetrahedralMesh& mesh,
    const FixedPointRays& view, const std::vector<RayClippingPlane>& clippingPlanes,
    const RefractedOptics& optics, InstructionSet set);

  /** Buffers of one thread. */
  struct Workspace
  {
    struct OfFrame
    {
      std::vector<RayBundleEntries::Line> Lines;
      std::vector<std::int32_t> Pixels;
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
    std::vector<PacketRay> Rays;
    /** Index of the line of each ray. */
    std::vector<std::int32_t> Lines;
    std::vector<PacketEntry> Entries;
    std::vector<PacketResult> Results;
    StraightPart Straight;
  };

  /**
   * @param job as for straight rays, but without rays.
   * @param box pixels of the tile.
   * @param rays RefractedRayField::GetTile().
   * @param opaqueDepth window depth in [0, 1] per pixel of the image; null for none.
   * @param workspace its Straight is read and overwritten.
   * @param image premultiplied RGBA per pixel.
   */
  RayStatistics Cast(PacketJob job, const BoundaryRaster::PixelBox& box, const RefractedRay* rays,
    const float* opaqueDepth, Workspace& workspace, float* image) const;

private:
  struct Part;
  bool FindPart(const BoundaryRaster::PixelBox& box, std::int32_t pixel,
    const RefractedRay& refracted, const float* opaqueDepth, Part& part) const;
  void AddLine(const Part& part, std::int32_t pixel, std::int32_t end, Workspace& workspace) const;
  void CollectBlock(Workspace& workspace) const;
  void CastFrame(const PacketJob& job, int frame, Workspace& workspace, RayStatistics& sums) const;
  void CastAgain(const PacketJob& job, int frame, Workspace& workspace, RayStatistics& sums) const;
  void Join(const PacketJob& job, Workspace::OfFrame& work, Workspace& workspace,
    RayStatistics& sums) const;
  void Finish(const PacketJob& job, const BoundaryRaster::PixelBox& box, const StraightPart& values,
    float* image, RayStatistics& sums) const;

  bool MayMeetMesh(const glm::dvec3& sightPoint, const glm::dvec3& step) const;

  RefractedScene Scene;
  /** Bounding box and bounding sphere of the mesh's boundary, in the frame of the view. */
  BoundsInFrame Box;
  double BallRadius = 0.0;
  const FixedPointRays& View;
  const std::vector<RayClippingPlane>& ClippingPlanes;
  std::vector<RayBundleEntries> Entries;
  /** Lighting and gradients in each frame. */
  struct Optics
  {
    SurfaceLighting Lighting;
    glm::dmat3 GradientToFrame{ 1.0 };
    GradientShadingTable Medium;
  };
  std::array<Optics, RefractionFrames::Number> OpticsOf;
  bool Lit;
  InstructionSet Set;
};

}

#endif
