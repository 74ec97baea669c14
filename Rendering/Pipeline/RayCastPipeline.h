// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Pipeline_RayCastPipeline_h
#define meniscus_Rendering_Pipeline_RayCastPipeline_h

#include "Rendering/Backends/Native/RayCastNative.h"
#include "Rendering/Backends/OpenGL/RayCastOpenGL.h"
#include "Rendering/Common/TableCounter.h"
#include "Rendering/Input/VolumeComponents.h"
#include "Rendering/Input/VolumeInput.h"
#include "Rendering/Pipeline/RayCastMembrane.h"
#include "Rendering/Property/RayCastOptics.h"
#include "Rendering/Property/VolumePreIntegration.h"
#include "Rendering/Property/VolumePropertyTables.h"
#include "Volume/Entries/EntryTiles.h"
#include "Volume/Rays/FixedPointRays.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

class vtkMatrix4x4;
class vtkRenderer;
class vtkVolume;

namespace meniscus
{

/** The same matrix in column-vector convention. */
glm::dmat4 ToGlm(vtkMatrix4x4* matrix);

/**
 * Drawing of a mapper's input: holds the tables of mesh, scalars and property, and the backends
 * that draw them. Tables of a backend are updated when it draws. Errors are returned as texts,
 * empty if there is none.
 */
class RayCastPipeline
{
public:
  VolumeInput Input;
  VolumeComponents Components;
  VolumePropertyTables Property;
  VolumePreIntegration PreIntegration;
  RayCastOpenGL OpenGL;
  RayCastNative Native;
  RayCastMembrane Membrane;

  /**
   * Computes the frame of the rays, and the place of the mesh in it, for an image of the given
   * size.
   */
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], ViewContext& place) const;
  /**
   * Name of the table of a frame that exceeds a limit in texels or the graphics device's own limit;
   * empty if none does.
   */
  std::string DescribeExcess(const RayCastFrame& frame, std::int64_t limit) const;
  std::string DrawOpenGL(const RayCastFrame& frame);
  std::string DrawNative(const RayCastFrame& frame);

  /** Number of times that entries were listed per tile on the CPU, for shaders. */
  std::int64_t GetEntryListBuilds() const { return this->EntryListBuilds; }
  std::int64_t GetEntryListBytes() const { return this->Tiles.GetBytes(); }
  /**
   * Updates the gradients that the optics need.
   * @param parts source of the input's scalars.
   */
  void UpdateGradients(const InputBlocks& parts, const RayCastOptics& optics);
  /** Number of computations of gradients at the vertices. */
  std::int64_t GetGradientBuilds() const { return this->VertexGradients.Builds; }
  /** Bytes of gradients. */
  std::int64_t GetGradientBytes() const
  {
    return BytesOf(this->VertexGradients.Values) + BytesOf(this->CellGradients.Values);
  }

  /** Bytes of tables sent to the graphics device, and of those created for the native backend. */
  std::int64_t GetUploadedBytes() const
  {
    return this->OpenGL.GetTables().GetUploadedBytes() + this->NativeTables.GetBytes();
  }

private:
  /** Gradients, and the input's counters for which they were computed. */
  struct Gradients
  {
    std::vector<glm::vec3> Values;
    std::int64_t Builds = 0;
    std::int64_t Mesh = 0;
    std::int64_t Scalars = 0;
  };

  std::string Upload(const RayCastOptics& optics);
  /** True if rays of the image are refracted. */
  bool Trace(const RayCastFrame& frame, const int (&imageSize)[2]);
  std::string UploadRefractedRays(const int (&imageSize)[2]);
  bool WantsLongLists(const RayCastFrame& frame);
  bool UpdateEntryTiles(const RayCastFrame& frame);
  std::string DrawStraight(const RayCastFrame& frame);
  void UpdateNative();
  void CountNativeTables(const RayCastOptics& optics);

  Gradients VertexGradients;
  Gradients CellGradients;

  /**
   * Lists of entries per tile for the shaders, and the rays and the boundary for which they are
   * valid.
   */
  EntryTiles Tiles;
  FixedPointRays RaysOfTiles;
  std::int64_t LinksOfTiles = 0;
  bool TilesFit = false;
  std::int64_t EntryListBuilds = 0;
  BoundaryMeasure Boundary;
  std::int64_t MeasuredLinks = 0;

  /** Counters of the inputs of the tables on the graphics device. */
  std::int64_t UploadedLinks = 0;
  std::int64_t UploadedMesh = 0;
  std::int64_t UploadedScalars = 0;
  std::int64_t UploadedCellScalars = 0;
  std::int64_t UploadedGradients = 0;
  std::int64_t UploadedCellGradients = 0;
  std::int64_t UploadedComponents = 0;
  std::int64_t UploadedProperty = 0;
  std::int64_t UploadedPreIntegration = 0;
  std::int64_t UploadedSight = 0;
  std::int64_t UploadedTiles = 0;
  /** The same counters for the native backend's tables. */
  std::int64_t NativeProperty = 0;
  TableCounter NativeTables;
};

}

#endif
