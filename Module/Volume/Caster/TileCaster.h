// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Simd/InstructionSets.h"
#include "Volume/Caster/InterpolatedRays.h"
#include "Volume/Caster/JoinedRays.h"
#include "Volume/Caster/LegBatch.h"
#include "Volume/Caster/LegFrame.h"
#include "Volume/Caster/MeasuredRays.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/PixelRays.h"
#include "Volume/Caster/RefractedLegEntries.h"
#include "Volume/Caster/SightLegEntries.h"
#include "Volume/Mesh/CellPassages.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/PreIntegration.h"
#include "Volume/Optics/RefractionMedium.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/RayStatistics.h"
#include "Volume/Refracted/RayLegs.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

/**
 * Casts the rays of an image by tiles, which are independent of each other. A ray is a list of
 * legs, which are cast one after the other: the lines of a leg are collected, with the faces by
 * which they enter the mesh, cast in packets and joined to the legs in front of them.
 */
class TileCaster
{
public:
  struct Scene
  {
    const TetrahedralMesh* Mesh = nullptr;
    /** Passages of the mesh's cells. */
    const std::vector<CellPassages>* Passages = nullptr;
    /** Boundary by which rays enter. */
    const std::vector<BoundaryFace>* Boundary = nullptr;
    const PacketTables* Tables = nullptr;
    /**
     * One normalised scalar per cell, used instead of the scalars of the vertices; null for none.
     */
    const float* CellScalars = nullptr;
    BlendMode Blending = BlendMode::Composite;
    /** Quantities that Measure() measures. It reads the same other members as a picture does. */
    RayMeasuring Measuring = RayMeasuring::None;
    /** True if bins have an attenuation and an emission, instead of three values. */
    bool Emitting = false;
    /** Accumulated opacity at which RayEventKind::OpacityReachedEvent is, in [0, 1]. */
    double EventOpacity = 0.5;
    /** Bit i is set if event i (RayEventKind) is wanted: rays end when all of them are known. */
    std::uint32_t WantedEvents = (1u << NumberOfRayEvents) - 1u;
    /** Depth in the frame of the rays from which distances along a ray count. */
    double MeasuredFrom = 0.0;
    /**
     * Mixture of the components of vertices in composite blending, and the components besides the
     * scalar. A vertex with a value that is NaN has no scalar either. For RayMeasuring::VertexBins,
     * Components has the values of the bins.
     */
    ComponentMixture Mixture = ComponentMixture::None;
    const glm::vec3* Components = nullptr;
    /** Normalised scalars that additive blending maps to 0 and to 1. */
    ScalarRange DataRange;
    /** Table that is used instead of the transfer function; null for none. */
    const PreIntegrationTable* PreIntegration = nullptr;
    /** Lighting of isosurfaces and of composite blending; null for none. */
    const SurfaceLighting* Lighting = nullptr;
    /** Medium behind the first interface, through which pictures are seen; null for none. */
    const RefractionMedium* Medium = nullptr;
    /**
     * Gradient of the scalar per vertex, in normalised model coordinates; null if gradients of
     * cells are used.
     */
    const glm::vec3* VertexGradients = nullptr;
    /**
     * Gradient per cell, in the same coordinates; required for lighting and gradient opacity
     * without VertexGradients. For RayMeasuring::CellBins, the values of the bins.
     */
    const glm::vec3* CellGradients = nullptr;
    glm::dmat3 GradientToFrame{ 1.0 };
    /** Light at each vertex, NumberOfVertexLights values per vertex; null without shadows. */
    const glm::vec3* VertexLight = nullptr;
    /** True if Tables has a gradient opacity, a factor of the attenuation. */
    bool GradientOpacity = false;
    /** Factor from the length of a gradient in the frame to the argument of that table. */
    double GradientMagnitude = 1.0;
    FixedPointRays Rays;
    /**
     * Rays of a pixel along each axis, from 1 to 32: `Rays` belong to an image with so many times
     * the columns and rows, divisible by it. 1 unless Refine() is called and no ray is refracted.
     */
    int RaysAcross = 1;
    /**
     * Whether Cast() may interpolate rays that differ little (InterpolatedRays), which must be
     * zero in its image. Rays of isosurfaces, and of tiles in which several legs may meet the mesh,
     * are cast.
     */
    bool Interpolating = false;
    /** Rays of the pixels' centres, and the tiles for which Refine() is called. */
    BoundaryRaster::Refinement Refining{};
    /** Planes that clip rays: only the part of a ray on the kept side of all of them is drawn. */
    std::vector<RayClippingPlane> ClippingPlanes;
    /** Transmittance at or below which a ray ends. */
    float TerminationTransmittance = 0.0f;
    InstructionSet Set = InstructionSet::Portable;
    /** Refraction of the rays; none without further legs. */
    RefractedScene Refracted;
  };

  /**
   * All objects that `scene` refers to must outlive this object.
   * @param loop runs over the faces of the boundary.
   */
  explicit TileCaster(const Scene& scene, const RangeLoop& loop = SerialLoop);
  TileCaster(const TileCaster&) = delete;
  TileCaster& operator=(const TileCaster&) = delete;

  /** Sets the mesh and the tables that map scalars to colours, except the tables of LegFrame. */
  static void SetOptics(const Scene& scene, PacketJob& job);

  /** Pixels in a row of a tile, in the image of Refine(). */
  static int PixelsAcrossTile(int raysAcross) { return BoundaryRaster::TileSize / raysAcross; }
  const BoundaryRaster& GetRaster() const { return this->Sight.GetRaster(); }
  int GetNumberOfTiles() const { return this->Legs.GetNumberOfTiles(); }
  int GetWidth() const { return this->Legs.GetWidth(); }
  int GetHeight() const { return this->Legs.GetHeight(); }
  BoundaryRaster::PixelBox GetBox(int tile) const
  {
    return this->Sight.GetRaster().BoxOfTile(tile);
  }

  /** Buffers of one thread. Thread-local storage instantiates its members many times over. */
  struct Workspace
  {
    Workspace();
    Workspace(const Workspace&);
    ~Workspace();

    SightLegEntries::Workspace Sight;
    RefractedLegEntries::Workspace Refracted;
    std::vector<PacketResult> Results;
    /** PacketJob::PathsAtPivot of a batch. */
    std::vector<float> Paths;
    JoinedRays Joined;
    PixelRays Refining;
    InterpolatedRays Interpolated;
    InterpolatedRays::NumbersOfEntries NumbersOfEntries;
    /** Values of a batch that is measured, and the measurements of the tile. */
    std::vector<float> Values;
    std::vector<RayEventState> EventStates;
    MeasuredRays Measured;
  };

  /**
   * Casts the rays of a tile.
   * @param opaqueDepth window depth in [0, 1] per pixel, at which rays end; null for none.
   * @param image premultiplied RGBA per pixel; pixels whose rays miss the mesh are not written.
   */
  RayStatistics Cast(int tile, const float* opaqueDepth, float* image, Workspace& workspace) const;
  /** Codes of the edges of an image's pixels (PixelEdge), and the highest level without rays. */
  struct EdgesOfImage
  {
    const std::uint8_t* Codes;
    int Tolerated;
  };
  /**
   * Casts several rays for each pixel at an edge (PixelRays), and sets it to the mean of their
   * colours. Tiles consist of whole pixels.
   * @param opaqueDepth,image as in Cast(), per pixel, with the colour of one ray per pixel.
   */
  RayStatistics Refine(int tile, const float* opaqueDepth, const EdgesOfImage& edges, float* image,
    Workspace& workspace) const;
  /** Pixels of a tile, in the image of Refine(). */
  BoundaryRaster::PixelBox GetPixels(int tile) const;
  /**
   * Measures the rays of a tile; Workspace::Measured has the results, for scalars, bins or events.
   * A ray that meets nothing has zeros.
   * @param opaqueDepth as in Cast(); null, so that rays are measured to the end, for none.
   */
  RayStatistics Measure(int tile, Workspace& workspace, const float* opaqueDepth = nullptr) const;

private:
  FrameOptics SightOptics() const;
  /** A tile that is being cast. */
  struct TileWork;
  void SetPictureOptics(PacketJob& job) const;
  TileLeg FirstLeg(int tile, const float* opaqueDepth) const;
  int FindShowingLeg(int tile, int leg) const;
  bool JoinsLegs(int tile) const;
  bool Interpolates(const PacketJob& job) const;
  void ListEntries(const TileLeg& leg, TileWork& work) const;
  void CastSome(TileLeg leg, float* image, TileWork& work) const;
  void CastLegs(TileLeg leg, TileWork& work) const;
  void CastOneLeg(const TileLeg& leg, TileWork& work) const;
  template <class Entries>
  void CastLeg(const Entries& entries, typename Entries::Workspace& found, const TileLeg& leg,
    TileWork& work) const;
  template <class Entries>
  void FindPaths(const Entries& entries, int frame, const TileLeg& leg, const LegBatch& batch,
    Workspace& workspace) const;
  void CastBatch(const LegBatch& batch, PacketJob& job, Workspace& workspace) const;
  template <class Entries>
  void JoinMeasured(const Entries& entries, int frame, const TileLeg& leg, const LegBatch& batch,
    std::size_t ray, Workspace& workspace) const;
  static void Show(const LegBatch& batch, const std::vector<PacketResult>& results, TileWork& work);

  Scene Input;
  RayLegs Legs;
  PacketSegmentTable SegmentTable{};
  PacketFading Fading{};
  SightLegEntries Sight;
  std::unique_ptr<RefractedLegEntries> Refracted;
};

}
