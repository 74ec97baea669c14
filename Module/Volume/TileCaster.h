// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_TileCaster_h
#define meniscus_Volume_TileCaster_h

#include "Volume/ClippingPlanes.h"
#include "Volume/EntryRaster.h"
#include "Volume/Packet/Packet.h"
#include "Volume/PixelRays.h"
#include "Volume/RayStatistics.h"
#include "Volume/TetrahedralMesh.h"
#include "Volume/TransferFunction.h"

#include <vector>

namespace meniscus
{

/** What the packets read, in their layout; see the builders below. */
struct PacketTables
{
  std::vector<PacketVertex> Vertices;
  std::vector<PacketInterval> Intervals;
};

/** @param scalars  one normalised scalar per mesh vertex; NaN makes its cells transparent. */
std::vector<PacketVertex> PackVertices(
  const TetrahedralMesh& mesh, const std::vector<float>& scalars);
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
    RayFrame Frame;
    /** Rays count where all of them keep them. */
    std::vector<RayClippingPlane> ClippingPlanes;
    int Width = 0;
    int Height = 0;
    /** Rays end when their transmittance is not above it. */
    float TerminationTransmittance = 0.0f;
    InstructionSet Set = InstructionSet::Portable;
  };

  /** What `scene` points at must outlive this. */
  explicit TileCaster(const Scene& scene);

  int GetNumberOfTiles() const { return this->Raster.GetNumberOfTiles(); }

  /** Room for the work of one thread. */
  struct Workspace
  {
    std::vector<EntryRaster::Hit> Hits;
    std::vector<PacketEntry> Entries;
    std::vector<PacketRay> Rays;
    std::vector<PacketResult> Results;
    std::vector<std::int64_t> Pixels;
  };

  /**
   * Casts the rays of a tile.
   * @param opaqueDepth  window depth in [0, 1] per pixel, where rays end; null: nowhere.
   * @param image        premultiplied RGBA per pixel; pixels whose rays miss the mesh are left.
   */
  RayStatistics Cast(int tile, const float* opaqueDepth, float* image, Workspace& workspace) const;

private:
  PacketRay RayOf(int column, int row, const float* opaqueDepth) const;
  void TakeHits(int tile, const float* opaqueDepth, Workspace& workspace) const;

  Scene Input;
  EntryRaster Raster;
};

}

#endif
