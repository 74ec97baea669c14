// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/RayCastNative.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Volume/Rays/PlacedVertices.h"

#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <cstddef>

namespace meniscus
{

//------------------------------------------------------------------------------
RayCastNative::RayCastNative()
  : Set(BestInstructionSet())
{
}

//------------------------------------------------------------------------------
void RayCastNative::UpdateProperty(const VolumePropertyTables& property)
{
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
std::int64_t RayCastNative::GetPropertyBytes() const
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
RayStatistics RayCastNative::Cast(TileCaster::Scene scene, const std::vector<float>& scalars,
  const VertexVersion& version, const std::vector<float>& opaqueDepth, std::vector<float>& image)
{
  if (version != this->PlacedVersion || !scene.Rays.PlacesAs(this->PlacedBy))
  {
    PlaceVertices(*scene.Mesh, scalars, scene.Rays, ThreadedLoop, this->Tables.Vertices);
    this->PlacedBy = scene.Rays;
    this->PlacedVersion = version;
  }
  scene.Tables = &this->Tables;
  scene.Set = this->Set;
  image.assign(std::size_t{ 4 } * scene.Rays.GetWidth() * scene.Rays.GetHeight(), 0.0f);
  const TileCaster caster(scene);
  std::vector<RayStatistics> ofTile(caster.GetNumberOfTiles());
  vtkSMPThreadLocal<TileCaster::Workspace> workspaces;
  // Tiles differ in cost: small grains let threads share it.
  vtkSMPTools::For(0, caster.GetNumberOfTiles(), 1,
    [&](vtkIdType first, vtkIdType last)
    {
      TileCaster::Workspace& workspace = workspaces.Local();
      for (vtkIdType tile = first; tile < last; ++tile)
      {
        ofTile[tile] =
          caster.Cast(static_cast<int>(tile), opaqueDepth.data(), image.data(), workspace);
      }
    });
  RayStatistics total;
  for (const RayStatistics& tile : ofTile)
  {
    total.Steps += tile.Steps;
    total.Rays += tile.Rays;
    total.Lost += tile.Lost;
  }
  return total;
}

}
