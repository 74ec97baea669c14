// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/NativeScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Volume/Rays/PlacedVertices.h"
#include "Volume/Rays/RayPivot.h"

namespace meniscus
{

//------------------------------------------------------------------------------
NativeScene::NativeScene()
  : Set(BestInstructionSet())
{
}

//------------------------------------------------------------------------------
void NativeScene::UpdateProperty(const VolumePropertyTables& property)
{
  if (this->PropertyVersion == property.GetVersion())
  {
    return;
  }
  this->PropertyVersion = property.GetVersion();
  this->Tables.Intervals = PackIntervals(property.GetIntervals());
  this->Tables.GradientIntervals = PackIntervals(property.GetGradientIntervals());
  this->Tables.OtherIntervals.clear();
  for (const std::vector<TransferFunctionInterval>& intervals : property.GetOtherIntervals())
  {
    this->Tables.OtherIntervals.push_back(PackIntervals(intervals));
  }
  this->Tables.Surfaces.clear();
  for (const Isosurface& surface : property.GetIsosurfaces())
  {
    const glm::vec3& color = surface.Color;
    this->Tables.Surfaces.push_back(
      { surface.Scalar, surface.Opacity, { color.r, color.g, color.b } });
  }
}

//------------------------------------------------------------------------------
std::int64_t NativeScene::GetPropertyBytes() const
{
  std::int64_t bytes = BytesOf(this->Tables.Intervals) + BytesOf(this->Tables.Surfaces) +
    BytesOf(this->Tables.GradientIntervals);
  for (const std::vector<PacketInterval>& intervals : this->Tables.OtherIntervals)
  {
    bytes += BytesOf(intervals);
  }
  return bytes;
}

//------------------------------------------------------------------------------
std::int64_t NativeScene::GetVertexBytes() const
{
  return BytesOf(this->Tables.Vertices);
}

//------------------------------------------------------------------------------
TileCaster::Scene NativeScene::Make(
  RayCastTables& tables, const RayCastFrame& frame, int width, int height)
{
  const RayCastOptics& optics = frame.Optics;
  TileCaster::Scene scene;
  scene.Mesh = &tables.Input.GetMesh();
  scene.Boundary = &scene.Mesh->GetBoundary();
  scene.Tables = &this->Tables;
  scene.Set = this->Set;
  scene.CellScalars = optics.CellScalars ? tables.Input.GetCellScalars().data() : nullptr;
  scene.Lighting = optics.Shading ? &optics.Lighting : nullptr;
  scene.Medium = optics.IsFaded() ? &optics.Medium : nullptr;
  scene.VertexGradients =
    optics.VertexGradients ? tables.VertexGradients.GetValues().data() : nullptr;
  scene.CellGradients =
    optics.UsesCellGradients() ? tables.CellGradients.GetValues().data() : nullptr;
  scene.GradientToFrame = optics.GradientToFrame;
  scene.GradientOpacity = optics.GradientOpacity;
  scene.GradientMagnitude = optics.GradientMagnitude;
  scene.Blending = optics.Blending;
  scene.Mixture = optics.Components;
  scene.Components = optics.HasComponents() ? tables.Components.GetValues().data() : nullptr;
  scene.DataRange = optics.DataRange;
  scene.PreIntegration = optics.PreIntegrated ? &tables.PreIntegration.GetTable() : nullptr;
  scene.ClippingPlanes = optics.ClippingPlanes;
  scene.TerminationTransmittance = static_cast<float>(frame.TerminationTransmittance());
  if (frame.Refracting.Met)
  {
    scene.Refracted = tables.Membrane.See(tables.Input);
  }
  scene.Refracted.Drawn = LegsOf(frame.Refracting.Part);
  scene.Rays =
    FixedPointRays(frame.Rays, width, height, FindPivot(frame.Rays, width, height, *scene.Mesh));
  const VolumeInput& input = tables.Input;
  const TableVersions versions{ input.GetMeshVersion(), input.GetScalarVersion() };
  if (versions != this->PlacedVersions || !scene.Rays.PlacesAs(this->PlacedBy))
  {
    PlaceVertices(
      input.GetMesh(), input.GetScalars(), scene.Rays, ThreadedLoop, this->Tables.Vertices);
    this->PlacedBy = scene.Rays;
    this->PlacedVersions = versions;
  }
  return scene;
}

}
