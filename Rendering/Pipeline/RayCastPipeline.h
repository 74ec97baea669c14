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

/** The same matrix, of column vectors. */
glm::dmat4 ToGlm(vtkMatrix4x4* matrix);

/**
 * From a mapper's input to a picture: what is made of mesh, scalars and property, and the backends
 * that draw it. Tables of a backend are brought up to date when it draws. Errors are texts, empty
 * if there is none.
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

  /** Where the mesh lies for the rays of an image of so many pixels. */
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], ViewContext& place) const;
  /** Which table of a frame a limit in texels or the graphics device's own forbids; empty if none.
   */
  std::string DescribeExcess(const RayCastFrame& frame, std::int64_t limit) const;
  std::string DrawOpenGL(const RayCastFrame& frame);
  std::string DrawNative(const RayCastFrame& frame);

  /** Times that entries were listed per tile on the processor, for shaders. */
  std::int64_t GetEntryListBuilds() const { return this->EntryListBuilds; }
  std::int64_t GetEntryListBytes() const { return this->Tiles.GetBytes(); }
  /**
   * Brings the gradients that optics need up to date.
   * @param parts  what the input's scalars were taken from.
   */
  void UpdateGradients(const InputBlocks& parts, const RayCastOptics& optics);
  /** Computations of gradients at the vertices. */
  std::int64_t GetGradientBuilds() const { return this->VertexGradients.Builds; }
  /** Bytes of gradients. */
  std::int64_t GetGradientBytes() const
  {
    return BytesOf(this->VertexGradients.Values) + BytesOf(this->CellGradients.Values);
  }

  /** Bytes of tables sent to the graphics device, and of those made for the native backend. */
  std::int64_t GetUploadedBytes() const
  {
    return this->OpenGL.GetTables().GetUploadedBytes() + this->NativeTables.GetBytes();
  }

private:
  /** Gradients, and what they were computed from by the input's counters. */
  struct Gradients
  {
    std::vector<glm::vec3> Values;
    std::int64_t Builds = 0;
    std::int64_t Mesh = 0;
    std::int64_t Scalars = 0;
  };

  std::string Upload(const RayCastOptics& optics);
  /** Whether rays of the image bend. */
  bool Trace(const RayCastFrame& frame, const int (&imageSize)[2]);
  std::string UploadRefractedRays(const int (&imageSize)[2]);
  bool WantsLongLists(const RayCastFrame& frame);
  bool UpdateEntryTiles(const RayCastFrame& frame);
  std::string DrawStraight(const RayCastFrame& frame);
  void UpdateNative();
  void CountNativeTables(const RayCastOptics& optics);

  Gradients VertexGradients;
  Gradients CellGradients;

  /** Entries per tile on the way to the shaders, and the rays and the boundary that they are of. */
  EntryTiles Tiles;
  FixedPointRays RaysOfTiles;
  std::int64_t LinksOfTiles = 0;
  bool TilesFit = false;
  std::int64_t EntryListBuilds = 0;
  BoundaryMeasure Boundary;
  std::int64_t MeasuredLinks = 0;

  /** What the tables on the graphics device were made of, by counters. */
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
  /** The same of the native backend's. */
  std::int64_t NativeProperty = 0;
  TableCounter NativeTables;
};

}

#endif
