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

/** A membrane as the rays of an image see it; see RayCastMembrane for what makes it. */
struct RefractedScene
{
  const RefractedRayField* Sight = nullptr;
  /** With the vertices placed. */
  const RefractionFrames* Frames = nullptr;
  /** Over the boundary that rays enter by. */
  const BoundaryTree* Tree = nullptr;
  /** Whether a ray may begin in the cell that the membrane is in; else it does on the boundary. */
  bool BeginsInside = false;
  MembranePart Part = MembranePart::Whole;
};

/** What depends on the frame of the rays, in that of the view; as of GradientShadingTable::Pack().
 */
struct RefractedOptics
{
  const SurfaceLighting* Lighting;
  glm::dmat3 GradientToFrame;
  double GradientMagnitude;
  const std::vector<PacketInterval>* GradientOpacity;
};

/** What the straight rays of a tile have come to at the membrane. */
struct StraightPart
{
  /** By pixel of the tile, in rows of RefractedRayField::TileSize: PacketResult's values and End.
   */
  std::vector<std::array<float, 4>> Values;
  std::vector<std::int32_t> Ends;
  /** Cells crossed so far. */
  std::vector<std::int32_t> Steps;

  /** @param end  of rays without a result: PacketResult::End. */
  void Clear(BlendMode mode, std::int32_t end);
};

/** Casts the rays of a tile behind the membrane and joins them with what lies before it. */
class RefractedRayCaster
{
public:
  /** What the arguments point at must outlive this. */
  RefractedRayCaster(const RefractedScene& scene, const TetrahedralMesh& mesh,
    const FixedPointRays& view, const std::vector<RayClippingPlane>& clippingPlanes,
    const RefractedOptics& optics, InstructionSet set);

  /** Room for the work of one thread. */
  struct Workspace
  {
    struct OfFrame
    {
      std::vector<RayBundleEntries::Line> Lines;
      std::vector<std::int32_t> Pixels;
      std::vector<RayBundleEntries::Hit> Hits;
      /** Lines of the block at hand whose start is known to be outside of the mesh, and others. */
      std::vector<std::int32_t> Bundles[2];
      /** Lines that began inside and did not come to the boundary. */
      std::vector<std::int32_t> RetryLines;
    };
    std::array<OfFrame, RefractionFrames::Number> Frames;
    RayBundleEntries::Workspace Faces;
    std::vector<PacketRay> Rays;
    /** Number of each ray's line. */
    std::vector<std::int32_t> Lines;
    std::vector<PacketEntry> Entries;
    std::vector<PacketResult> Results;
    StraightPart Straight;
  };

  /**
   * @param job          as for straight rays, without rays.
   * @param box          of the tile.
   * @param rays         RefractedRayField::GetTile().
   * @param opaqueDepth  window depth in [0, 1] per pixel of the image; null for none.
   * @param workspace    Straight is read and used up.
   * @param image        premultiplied RGBA per pixel.
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
  /** Box and ball about the mesh's boundary, in the frame of the view. */
  BoundsInFrame Box;
  double BallRadius = 0.0;
  const FixedPointRays& View;
  const std::vector<RayClippingPlane>& ClippingPlanes;
  std::vector<RayBundleEntries> Entries;
  /** The same in each frame. */
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
