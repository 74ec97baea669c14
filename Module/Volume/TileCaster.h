// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_TileCaster_h
#define meniscus_Volume_TileCaster_h

#include "Refraction/RangeLoop.h"
#include "Volume/BentCaster.h"
#include "Volume/ClippingPlanes.h"
#include "Volume/EntryRaster.h"
#include "Volume/MediumTable.h"
#include "Volume/Packet/Packet.h"
#include "Volume/PixelRays.h"
#include "Volume/PreIntegration.h"
#include "Volume/RayStatistics.h"
#include "Volume/TetrahedralMesh.h"
#include "Volume/TransferFunction.h"

#include <memory>
#include <vector>

namespace meniscus
{

/** What the packets read, in their layout; see the builders below. */
struct PacketTables
{
  /** As the rays of an image see them. */
  std::vector<PacketVertex> Vertices;
  std::vector<PacketInterval> Intervals;
  std::vector<PacketSurface> Surfaces;
  /** Of components that have functions of their own; of the lengths of gradients. */
  std::vector<std::vector<PacketInterval>> OtherIntervals;
  std::vector<PacketInterval> GradientIntervals;
};

/**
 * @param scalars   one normalised scalar per mesh vertex; NaN makes its cells transparent. Empty
 * for none, where cells have scalars.
 * @param vertices  replaced.
 */
void PlaceVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars,
  const PixelRays& rays, const RangeLoop& loop, std::vector<PacketVertex>& vertices);
std::vector<PacketInterval> PackIntervals(const std::vector<TransferFunctionInterval>& intervals);

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
    PacketBlending Blending = PacketBlending::Composite;
    /** How the components of vertices mix in composite blending, and those beside the scalar. */
    PacketMixture Mixture = PacketMixture::None;
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
    PixelRays Rays;
    /** Rays count where all of them keep them. */
    std::vector<RayClippingPlane> ClippingPlanes;
    /** Rays end when their transmittance is not above it. */
    float TerminationTransmittance = 0.0f;
    InstructionSet Set = InstructionSet::Portable;
    /** Rays that bend; without a Sight there are none. */
    BentScene Bent;
  };

  /** What `scene` points at must outlive this. */
  explicit TileCaster(const Scene& scene);
  TileCaster(const TileCaster&) = delete;
  TileCaster& operator=(const TileCaster&) = delete;

  int GetNumberOfTiles() const { return this->Raster.GetNumberOfTiles(); }

  /** Room for the work of one thread. */
  struct Workspace
  {
    EntryRaster::Workspace Entries;
    std::vector<PacketRay> Rays;
    std::vector<PacketResult> Results;
    std::vector<std::int64_t> Pixels;
    BentCaster::Workspace Bent;
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
    int tile, const float* opaqueDepth, const BentRay* bent, Workspace& workspace) const;
  void SetOptics(PacketJob& job) const;
  bool IsMeshInFront(int tile, const BentRay* bent) const;
  void CastStraight(PacketJob& job, Workspace& workspace) const;
  RayStatistics ShowStraight(const Workspace& workspace, float* image) const;
  void KeepStraight(int tile, const BentRay* bent, Workspace& workspace) const;

  Scene Input;
  EntryRaster Raster;
  MediumTable Medium;
  PacketSegmentTable SegmentTable{};
  std::unique_ptr<BentCaster> Bent;
};

}

#endif
