// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pipeline/RayCastPipeline.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Volume/Mesh/ScalarGradients.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/RefractedRayTexels.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <glm/geometric.hpp>

namespace meniscus
{

//------------------------------------------------------------------------------
glm::dmat4 ToGlm(vtkMatrix4x4* matrix)
{
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[column][row] = matrix->GetElement(row, column);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::Upload(const RayCastOptics& optics)
{
  VolumeInput& input = this->Input;
  std::string error;
  const bool linksStale = this->UploadedLinks != input.GetLinkChanges();
  if (linksStale || !this->OpenGL.GetTables().HasCells(optics.CompactCells))
  {
    error = this->OpenGL.GetTables().UploadCells(input.GetMesh(), optics.CompactCells);
  }
  if (error.empty() && (linksStale || !this->OpenGL.GetTables().HasBoundary()))
  {
    error = this->OpenGL.GetTables().UploadBoundary(input.GetBoundaryTree());
  }
  if (linksStale || !error.empty())
  {
    this->UploadedLinks = error.empty() ? input.GetLinkChanges() : 0;
  }
  const bool ofCells = input.GetFieldAssociation() == FieldAssociation::Cells;
  const bool verticesStale = this->UploadedMesh != input.GetMeshBuilds() ||
    (!ofCells && this->UploadedScalars != input.GetScalarUpdates());
  if (error.empty() && (verticesStale || !this->OpenGL.GetTables().HasVertices()))
  {
    error = this->OpenGL.GetTables().UploadVertices(input.GetMesh(), input.GetScalars());
    this->UploadedMesh = error.empty() ? input.GetMeshBuilds() : 0;
    this->UploadedScalars = input.GetScalarUpdates();
  }
  const bool cellScalarsStale = this->UploadedCellScalars != input.GetScalarUpdates();
  if (error.empty() && ofCells && (cellScalarsStale || !this->OpenGL.GetTables().HasCellScalars()))
  {
    error = this->OpenGL.GetTables().UploadCellScalars(input.GetCellScalars());
    this->UploadedCellScalars = error.empty() ? input.GetScalarUpdates() : 0;
  }
  const bool gradientsStale = this->UploadedGradients != this->VertexGradients.Builds;
  if (error.empty() && optics.VertexGradients &&
    (gradientsStale || !this->OpenGL.GetTables().HasGradients()))
  {
    error = this->OpenGL.GetTables().UploadGradients(this->VertexGradients.Values);
    this->UploadedGradients = error.empty() ? this->VertexGradients.Builds : 0;
  }
  const bool cellGradientsStale = this->UploadedCellGradients != this->CellGradients.Builds;
  if (error.empty() && optics.UsesCellGradients() &&
    (cellGradientsStale || !this->OpenGL.GetTables().HasCellGradients()))
  {
    error = this->OpenGL.GetTables().UploadCellGradients(this->CellGradients.Values);
    this->UploadedCellGradients = error.empty() ? this->CellGradients.Builds : 0;
  }
  const bool componentsStale = this->UploadedComponents != this->Components.GetVersion();
  if (error.empty() && optics.HasComponents() &&
    (componentsStale || !this->OpenGL.GetTables().HasComponents()))
  {
    error = this->OpenGL.GetTables().UploadComponents(this->Components.GetValues());
    this->UploadedComponents = error.empty() ? this->Components.GetVersion() : 0;
  }
  const bool propertyStale = this->UploadedProperty != this->Property.GetVersion();
  if (error.empty() && (propertyStale || !this->OpenGL.GetTables().HasProperty()))
  {
    error = this->OpenGL.GetTables().UploadProperty(this->Property);
    this->UploadedProperty = error.empty() ? this->Property.GetVersion() : 0;
  }
  const std::int64_t table = this->PreIntegration.GetNumberOfBuilds();
  if (error.empty() && optics.PreIntegrated &&
    (this->UploadedPreIntegration != table || !this->OpenGL.GetTables().HasPreIntegration()))
  {
    error = this->OpenGL.GetTables().UploadPreIntegration(this->PreIntegration.GetTable());
    this->UploadedPreIntegration = error.empty() ? table : 0;
  }
  return error;
}

//------------------------------------------------------------------------------
void RayCastPipeline::UpdateGradients(const InputBlocks& parts, const RayCastOptics& optics)
{
  if (!optics.VertexGradients && !optics.UsesCellGradients())
  {
    return;
  }
  const VolumeInput& input = this->Input;
  Gradients& gradients = optics.VertexGradients ? this->VertexGradients : this->CellGradients;
  if (gradients.Mesh == input.GetMeshBuilds() && gradients.Scalars == input.GetScalarUpdates())
  {
    return;
  }
  const std::vector<double> scalars =
    GatherValues(parts, input.GetComponent(), input.GetSources(FieldAssociation::Points));
  const double scale = input.GetNormalization().GradientScale;
  gradients.Values = optics.VertexGradients
    ? ComputeVertexGradients(input.GetMesh(), scalars, scale)
    : ComputeCellGradients(input.GetMesh(), scalars, scale, ThreadedLoop);
  gradients.Mesh = input.GetMeshBuilds();
  gradients.Scalars = input.GetScalarUpdates();
  ++gradients.Builds;
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::DescribeExcess(const RayCastFrame& frame, std::int64_t limit) const
{
  const std::string error = this->OpenGL.GetTables().DescribeExcess(this->Input.GetMesh(),
    frame.Optics.CompactCells, frame.Refracting.Wanted ? 1 + RefractionFrames::Number : 1, limit);
  return error.empty() && frame.Refracting.Wanted
    ? OpenGLRefractedRays::DescribeExcess(frame.Output.ImageSize, limit)
    : error;
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::DrawOpenGL(const RayCastFrame& frame)
{
  std::string error = this->Upload(frame.Optics);
  const bool bends = frame.Refracting.Wanted && this->Trace(frame, frame.Output.ImageSize);
  if (error.empty() && bends)
  {
    error = this->UploadRefractedRays(frame.Output.ImageSize);
  }
  if (!error.empty() || (!bends && frame.Refracting.Part == MembranePart::Behind))
  {
    return error;
  }
  if (!bends)
  {
    return this->DrawStraight(frame);
  }
  RayCastFrame refracted = frame;
  refracted.Optics.Refracting = true;
  refracted.Refracting.BeginsInside = this->Membrane.BeginsInside(this->Input);
  refracted.Refracting.Version = { this->Membrane.GetSightUpdates(), this->Input.GetLinkChanges() };
  return this->OpenGL.Draw(refracted);
}

//------------------------------------------------------------------------------
/**
 * True if rays of a tile are expected to enter by more faces than the device-made lists hold. Rays
 * of tiles with more faces search the tree of the boundary one by one.
 */
bool RayCastPipeline::WantsLongLists(const RayCastFrame& frame)
{
  if (this->MeasuredLinks != this->Input.GetLinkChanges())
  {
    this->Boundary = MeasureBoundary(this->Input.GetMesh());
    this->MeasuredLinks = this->Input.GetLinkChanges();
  }
  // Half of the tiles have more than the mean.
  constexpr double most = 0.5 * RayCastOpenGL::TileCapacity;
  const double side = RayCastOpenGL::TileSize * glm::length(frame.Rays.Origin.PerColumn);
  return ExpectedEntriesPerTile(this->Boundary, side) > most;
}

//------------------------------------------------------------------------------
/**
 * Lists entries for shaders if rays or boundary have changed. Returns false if the lists do not
 * fit.
 */
bool RayCastPipeline::UpdateEntryTiles(const RayCastFrame& frame)
{
  const FixedPointRays rays(frame.Rays, frame.Output.ImageSize[0], frame.Output.ImageSize[1]);
  OpenGLTables& tables = this->OpenGL.GetTables();
  if (this->LinksOfTiles != this->Input.GetLinkChanges() || !rays.SeesAs(this->RaysOfTiles))
  {
    this->TilesFit =
      this->Tiles.Build(this->Input.GetMesh(), this->Input.GetBoundaryTree().GetFaces(), rays,
        RayCastOpenGL::LongListTileSize, ThreadedLoop);
    this->RaysOfTiles = rays;
    this->LinksOfTiles = this->Input.GetLinkChanges();
    ++this->EntryListBuilds;
  }
  const bool uploaded = tables.HasEntryTiles() && this->UploadedTiles == this->EntryListBuilds;
  if (this->TilesFit && !uploaded)
  {
    this->TilesFit = tables.UploadEntryTiles(this->Tiles).empty();
    this->UploadedTiles = this->EntryListBuilds;
  }
  return this->TilesFit;
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::DrawStraight(const RayCastFrame& frame)
{
  if (!this->WantsLongLists(frame) || !this->UpdateEntryTiles(frame))
  {
    return this->OpenGL.Draw(frame);
  }
  RayCastFrame listed = frame;
  listed.Optics.LongLists = true;
  return this->OpenGL.Draw(listed);
}

//------------------------------------------------------------------------------
bool RayCastPipeline::Trace(const RayCastFrame& frame, const int (&imageSize)[2])
{
  const RayCastRefraction& refracting = frame.Refracting;
  return this->Membrane.Trace({ frame.Rays, imageSize[0], imageSize[1], refracting.Center,
                                refracting.EyeDepth, refracting.Exterior, refracting.Interior, {} },
    this->Input);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::UploadRefractedRays(const int (&imageSize)[2])
{
  OpenGLTables& tables = this->OpenGL.GetTables();
  const std::int64_t version = this->Membrane.GetSightUpdates();
  if (this->UploadedSight == version && tables.HasRefractedRays())
  {
    return std::string();
  }
  std::vector<RefractedRayLine> lines;
  LayOutRefractedRays(this->Membrane.GetSight(), this->Membrane.GetFrames(), ThreadedLoop, lines);
  const std::string error =
    tables.UploadRefractedRays(lines, imageSize[0], imageSize[1], this->Membrane.GetFrames());
  this->UploadedSight = error.empty() ? version : 0;
  return error;
}

//------------------------------------------------------------------------------
void RayCastPipeline::UpdateNative()
{
  if (this->NativeProperty != this->Property.GetVersion())
  {
    this->Native.UpdateProperty(this->Property);
    this->NativeProperty = this->Property.GetVersion();
  }
}

//------------------------------------------------------------------------------
/** Counts the tables that Upload() would send, which the native backend reads in place. */
void RayCastPipeline::CountNativeTables(const RayCastOptics& optics)
{
  TableCounter& tables = this->NativeTables;
  const VolumeInput& input = this->Input;
  const TetrahedralMesh& mesh = input.GetMesh();
  tables.Count(TableCounter::Cells, { input.GetLinkChanges(), 0 },
    TableCounter::SizeOf(mesh.GetCells()) + TableCounter::SizeOf(mesh.GetBoundary()));
  const std::int64_t scalars = input.GetScalarUpdates();
  const std::int64_t positions = TableCounter::SizeOf(mesh.GetFixedPositions());
  if (optics.CellScalars)
  {
    tables.Count(TableCounter::Vertices, { input.GetMeshBuilds(), 0 }, positions);
    tables.Count(
      TableCounter::CellScalars, { scalars, 0 }, TableCounter::SizeOf(input.GetCellScalars()));
  }
  else
  {
    tables.Count(TableCounter::Vertices, { input.GetMeshBuilds(), scalars },
      positions + TableCounter::SizeOf(input.GetScalars()));
  }
  if (optics.VertexGradients)
  {
    tables.Count(TableCounter::VertexGradients, { this->VertexGradients.Builds, 0 },
      TableCounter::SizeOf(this->VertexGradients.Values));
  }
  if (optics.UsesCellGradients())
  {
    tables.Count(TableCounter::CellGradients, { this->CellGradients.Builds, 0 },
      TableCounter::SizeOf(this->CellGradients.Values));
  }
  if (optics.HasComponents())
  {
    tables.Count(TableCounter::Components, { this->Components.GetVersion(), 0 },
      TableCounter::SizeOf(this->Components.GetValues()));
  }
  tables.Count(
    TableCounter::Functions, { this->Property.GetVersion(), 0 }, this->Native.GetPropertyBytes());
  if (optics.PreIntegrated)
  {
    tables.Count(TableCounter::PreIntegration, { this->PreIntegration.GetNumberOfBuilds(), 0 },
      TableCounter::SizeOf(this->PreIntegration.GetTable().GetValues()));
  }
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::DrawNative(const RayCastFrame& frame)
{
  this->UpdateNative();
  TileCaster::Scene scene;
  scene.Mesh = &this->Input.GetMesh();
  scene.Boundary = &this->Input.GetMesh().GetBoundary();
  scene.CellScalars = frame.Optics.CellScalars ? this->Input.GetCellScalars().data() : nullptr;
  scene.Lighting = frame.Optics.Shading ? &frame.Optics.Lighting : nullptr;
  scene.VertexGradients =
    frame.Optics.VertexGradients ? this->VertexGradients.Values.data() : nullptr;
  scene.CellGradients =
    frame.Optics.UsesCellGradients() ? this->CellGradients.Values.data() : nullptr;
  this->CountNativeTables(frame.Optics);
  scene.GradientToFrame = frame.Optics.GradientToFrame;
  scene.GradientOpacity = frame.Optics.GradientOpacity;
  scene.GradientMagnitude = frame.Optics.GradientMagnitude;
  scene.Blending = frame.Optics.Blending;
  scene.Mixture = frame.Optics.Components;
  scene.Components = frame.Optics.HasComponents() ? this->Components.GetValues().data() : nullptr;
  scene.DataRange = frame.Optics.DataRange;
  scene.PreIntegration = frame.Optics.PreIntegrated ? &this->PreIntegration.GetTable() : nullptr;
  scene.ClippingPlanes = frame.Optics.ClippingPlanes;
  scene.TerminationTransmittance = static_cast<float>(frame.TerminationTransmittance());
  return this->OpenGL.DrawImageOf(
    [this, &scene, &frame](
      int width, int height, const std::vector<float>& depths, std::vector<float>& image)
    {
      scene.Rays = FixedPointRays(frame.Rays, width, height);
      if (frame.Refracting.Wanted && this->Trace(frame, { width, height }))
      {
        scene.Refracted = this->Membrane.See(this->Input);
        this->NativeTables.Count(TableCounter::RefractedRays,
          { this->Membrane.GetSightUpdates(), 0 }, this->Membrane.GetSight().GetBytes());
      }
      scene.Refracted.Part = frame.Refracting.Part;
      const VertexVersion version{ this->Input.GetMeshBuilds(), this->Input.GetScalarUpdates() };
      return this->Native.Cast(scene, this->Input.GetScalars(), version, depths, image);
    },
    frame.Output);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::ComputeFrame(
  vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], ViewContext& place) const
{
  vtkCamera* camera = renderer->GetActiveCamera();
  RayFrameInput input;
  input.ModelToWorld = ToGlm(volume->GetMatrix());
  input.WorldToView = ToGlm(camera->GetModelViewTransformMatrix());
  input.ViewToClip =
    ToGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  input.Center = this->Input.GetMesh().GetCenter();
  input.Radius = this->Input.GetMesh().GetRadius();
  input.ImageSize = glm::dvec2(imageSize[0], imageSize[1]);
  place.CenterInWorld = glm::dvec3(input.ModelToWorld * glm::dvec4(input.Center, 1.0));
  place.WorldToView = input.WorldToView;
  place.GradientScale = this->Input.GetNormalization().GradientScale;
  switch (ComputeRayFrame(input, place.Frame))
  {
    case RayFrameStatus::Ok:
      return std::string();
    case RayFrameStatus::Singular:
      return "the matrix of the volume or of the camera is singular or not finite";
    default:
      return "the camera's projection is not that of a plane image";
  }
}

}
