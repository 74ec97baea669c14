// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastPipeline.h"

#include "ThreadedLoop.h"
#include "Volume/BentLines.h"
#include "Volume/RayFrame.h"
#include "Volume/VertexGradients.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

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
  const bool ofCells = input.GetScalarPlace() == ScalarPlace::Cells;
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
  const bool gradientsStale = this->UploadedGradients != this->GradientBuilds;
  if (error.empty() && optics.VertexGradients &&
    (gradientsStale || !this->OpenGL.GetTables().HasGradients()))
  {
    error = this->OpenGL.GetTables().UploadGradients(this->Gradients);
    this->UploadedGradients = error.empty() ? this->GradientBuilds : 0;
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
void RayCastPipeline::UpdateGradients()
{
  const VolumeInput& input = this->Input;
  if (this->GradientsOfMesh != input.GetMeshBuilds() ||
    this->GradientsOfScalars != input.GetScalarUpdates())
  {
    this->Gradients = ComputeVertexGradients(input.GetMesh(), input.GetScalars());
    this->GradientsOfMesh = input.GetMeshBuilds();
    this->GradientsOfScalars = input.GetScalarUpdates();
    ++this->GradientBuilds;
  }
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::DescribeExcess(const RayCastFrame& frame, std::int64_t limit) const
{
  const std::string error = this->OpenGL.GetTables().DescribeExcess(this->Input.GetMesh(),
    frame.Optics.CompactCells, frame.Bending.Wanted ? 1 + BentFrames::Number : 1, limit);
  return error.empty() && frame.Bending.Wanted
    ? OpenGLBentLines::DescribeExcess(frame.Output.ImageSize, limit)
    : error;
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::DrawOpenGL(const RayCastFrame& frame)
{
  if (frame.Optics.VertexGradients)
  {
    this->UpdateGradients();
  }
  std::string error = this->Upload(frame.Optics);
  const bool bends = frame.Bending.Wanted && this->Trace(frame, frame.Output.ImageSize);
  if (error.empty() && bends)
  {
    error = this->UploadBentLines(frame.Output.ImageSize);
  }
  if (!error.empty() || (!bends && frame.Bending.Part == MembranePart::Behind))
  {
    return error;
  }
  if (!bends)
  {
    return this->OpenGL.Draw(frame);
  }
  RayCastFrame bent = frame;
  bent.Optics.Bending = true;
  bent.Bending.BeginsInside = this->Membrane.BeginsInside(this->Input);
  bent.Bending.Version = { this->Membrane.GetSightUpdates(), this->Input.GetLinkChanges() };
  return this->OpenGL.Draw(bent);
}

//------------------------------------------------------------------------------
bool RayCastPipeline::Trace(const RayCastFrame& frame, const int (&imageSize)[2])
{
  const RayCastBending& bending = frame.Bending;
  return this->Membrane.Trace({ frame.Rays, imageSize[0], imageSize[1], bending.Center,
                                bending.EyeDepth, bending.Exterior, bending.Interior, {} },
    this->Input);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::UploadBentLines(const int (&imageSize)[2])
{
  OpenGLTables& tables = this->OpenGL.GetTables();
  const std::int64_t version = this->Membrane.GetSightUpdates();
  if (this->UploadedSight == version && tables.HasBentLines())
  {
    return std::string();
  }
  std::vector<BentLine> lines;
  LayOutBentLines(this->Membrane.GetSight(), this->Membrane.GetFrames(), ThreadedLoop, lines);
  const std::string error =
    tables.UploadBentLines(lines, imageSize[0], imageSize[1], this->Membrane.GetFrames());
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
std::string RayCastPipeline::DrawNative(const RayCastFrame& frame)
{
  this->UpdateNative();
  TileCaster::Scene scene;
  scene.Mesh = &this->Input.GetMesh();
  scene.Boundary = &this->Input.GetMesh().GetBoundary();
  scene.CellScalars = frame.Optics.CellScalars ? this->Input.GetCellScalars().data() : nullptr;
  scene.Lighting = frame.Optics.Shading ? &frame.Optics.Lighting : nullptr;
  if (frame.Optics.VertexGradients)
  {
    this->UpdateGradients();
    scene.VertexGradients = this->Gradients.data();
  }
  scene.GradientToFrame = frame.Optics.GradientToFrame;
  scene.GradientOpacity = frame.Optics.GradientOpacity;
  scene.GradientMagnitude = frame.Optics.GradientMagnitude;
  // The numbers are the same.
  scene.Blending = static_cast<PacketBlending>(frame.Optics.BlendMode);
  scene.Mixture = static_cast<PacketMixture>(frame.Optics.Components);
  scene.Components = frame.Optics.HasComponents() ? this->Components.GetValues().data() : nullptr;
  scene.PreIntegration = frame.Optics.PreIntegrated ? &this->PreIntegration.GetTable() : nullptr;
  scene.ClippingPlanes = frame.Optics.ClippingPlanes;
  scene.TerminationTransmittance = static_cast<float>(frame.TerminationTransmittance());
  return this->OpenGL.DrawImageOf(
    [this, &scene, &frame](
      int width, int height, const std::vector<float>& depths, std::vector<float>& image)
    {
      scene.Rays = PixelRays(frame.Rays, width, height);
      if (frame.Bending.Wanted && this->Trace(frame, { width, height }))
      {
        scene.Bent = this->Membrane.See(this->Input);
      }
      scene.Bent.Part = frame.Bending.Part;
      const VertexVersion version{ this->Input.GetMeshBuilds(), this->Input.GetScalarUpdates() };
      return this->Native.Cast(scene, this->Input.GetScalars(), version, depths, image);
    },
    frame.Output);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::ComputeFrame(
  vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], OpticsPlace& place) const
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
  place.ScalarScale = this->Input.GetNormalization().Scale;
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
