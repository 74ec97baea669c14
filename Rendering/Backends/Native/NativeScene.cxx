// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/NativeScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/PacketScene.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Volume/Rays/ClippingPlanes.h"
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
  PackProperty(property, this->Tables);
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
  RayCastTables& tables, const RayCastFrame& frame, int width, int height, int raysAcross)
{
  const RayCastOptics& optics = frame.Optics;
  TileCaster::Scene scene;
  SetMedium(tables, optics, scene);
  scene.Tables = &this->Tables;
  scene.Set = this->Set;
  scene.Lighting = optics.Shading ? &optics.Lighting : nullptr;
  scene.VertexLight = optics.Illuminated ? tables.Illumination.GetValues().data() : nullptr;
  scene.Medium = optics.IsFaded() ? &optics.Medium : nullptr;
  scene.DataRange = optics.DataRange;
  scene.PreIntegration = optics.PreIntegrated ? &tables.PreIntegration.GetTable() : nullptr;
  scene.TerminationTransmittance = static_cast<float>(frame.TerminationTransmittance());
  if (frame.Refracting.Met)
  {
    scene.Refracted = tables.Membrane.See(tables.Input);
  }
  scene.Refracted.Drawn = LegsOf(frame.Refracting.Part);
  const RayFrame rays = raysAcross == 1 ? frame.Rays : Refined(frame.Rays, raysAcross);
  const int columns = raysAcross * width;
  const int rows = raysAcross * height;
  scene.Rays = FixedPointRays(rays, columns, rows, FindPivot(rays, columns, rows, *scene.Mesh));
  scene.RaysAcross = raysAcross;
  for (RayClippingPlane& plane : scene.ClippingPlanes)
  {
    plane = ForRays(plane, rays);
  }
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
