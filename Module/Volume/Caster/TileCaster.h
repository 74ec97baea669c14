// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_TileCaster_h
#define meniscus_Volume_Caster_TileCaster_h

#include "Common/RangeLoop.h"
#include "Simd/InstructionSets.h"
#include "Volume/Caster/GradientShadingTable.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/RefractedRayCaster.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/PreIntegration.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/RayStatistics.h"

#include <memory>
#include <vector>

namespace meniscus
{

/** Casts the rays of an image by tiles, which are independent of each other. */
class TileCaster
{
public:
  struct Scene
  {
    const TetrahedralMesh* Mesh = nullptr;
    /** The boundary that rays enter by. */
    const std::vector<BoundaryFace>* Boundary = nullptr;
    const PacketTables* Tables = nullptr;
    /** One normalised scalar per cell, in place of those of the vertices; null for none. */
    const float* CellScalars = nullptr;
    BlendMode Blending = BlendMode::Composite;
    /** How the components of vertices mix in composite blending, and those beside the scalar. */
    ComponentMixture Mixture = ComponentMixture::None;
    const glm::vec3* Components = nullptr;
    /** Normalised scalars that additive blending counts as 0 and as 1. */
    ScalarRange DataRange;
    /** Looked up in place of the transfer function; null for none. */
    const PreIntegrationTable* PreIntegration = nullptr;
    /** Of isosurfaces and of composite blending; null for none. */
    const SurfaceLighting* Lighting = nullptr;
    /** One per vertex, in normalised model coordinates; null for those of the cells. */
    const glm::vec3* VertexGradients = nullptr;
    /** One per cell, likewise; needed by light and gradient opacity without those of vertices. */
    const glm::vec3* CellGradients = nullptr;
    glm::dmat3 GradientToFrame{ 1.0 };
    /** Whether gradients change the attenuation, by the table of that. */
    bool GradientOpacity = false;
    /** From a gradient's length in the frame to what that table is of. */
    double GradientMagnitude = 1.0;
    FixedPointRays Rays;
    /** Rays count where all of them keep them. */
    std::vector<RayClippingPlane> ClippingPlanes;
    /** Rays end when their transmittance is not above it. */
    float TerminationTransmittance = 0.0f;
    InstructionSet Set = InstructionSet::Portable;
    /** Rays that bend; without a Sight there are none. */
    RefractedScene Refracted;
  };

  /** What `scene` points at must outlive this. */
  explicit TileCaster(const Scene& scene);
  TileCaster(const TileCaster&) = delete;
  TileCaster& operator=(const TileCaster&) = delete;

  int GetNumberOfTiles() const { return this->Raster.GetNumberOfTiles(); }

  /** Room for the work of one thread. */
  struct Workspace
  {
    BoundaryRaster::Workspace Entries;
    std::vector<PacketRay> Rays;
    std::vector<PacketResult> Results;
    std::vector<std::int64_t> Pixels;
    RefractedRayCaster::Workspace Refracted;
  };

  /**
   * Casts the rays of a tile.
   * @param opaqueDepth  window depth in [0, 1] per pixel, where rays end; null: nowhere.
   * @param image        premultiplied RGBA per pixel; pixels whose rays miss the mesh are left.
   */
  RayStatistics Cast(int tile, const float* opaqueDepth, float* image, Workspace& workspace) const;

private:
  PacketRay RayOf(int column, int row, const float* opaqueDepth, double farthest) const;
  void TakeRays(
    int tile, const float* opaqueDepth, const RefractedRay* refracted, Workspace& workspace) const;
  void SetOptics(PacketJob& job) const;
  bool IsMeshInFront(int tile, const RefractedRay* refracted) const;
  void CastStraight(PacketJob& job, Workspace& workspace) const;
  RayStatistics ShowStraight(const Workspace& workspace, float* image) const;
  void KeepStraight(int tile, const RefractedRay* refracted, Workspace& workspace) const;

  Scene Input;
  BoundaryRaster Raster;
  GradientShadingTable Medium;
  PacketSegmentTable SegmentTable{};
  std::unique_ptr<RefractedRayCaster> Refracted;
};

}

#endif
