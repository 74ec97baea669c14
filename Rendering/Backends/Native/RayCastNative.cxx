// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/RayCastNative.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Volume/Rays/PlacedVertices.h"

#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace meniscus
{
namespace
{

/** True if two images of one number per pixel are equal in the box. */
bool HaveEqualRows(const BoundaryRaster::PixelBox& box, int width, const std::vector<float>& a,
  const std::vector<float>& b)
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const std::ptrdiff_t start = std::ptrdiff_t{ row } * width;
    if (!std::equal(a.begin() + start + box.Left, a.begin() + start + box.Right,
          b.begin() + start + box.Left))
    {
      return false;
    }
  }
  return true;
}

/** True if a ray of the tile was drawn. */
bool IsFilled(const RayStatistics& tile)
{
  return tile.Rays > 0;
}

/** Sets the box of an image of four numbers per pixel to zero. */
void ClearRows(const BoundaryRaster::PixelBox& box, int width, std::vector<float>& image)
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const std::ptrdiff_t start = std::ptrdiff_t{ row } * width + box.Left;
    std::fill_n(image.begin() + 4 * start, 4 * (box.Right - box.Left), 0.0f);
  }
}

}

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
std::string RayCastNative::Update(const RayCastRequest& request)
{
  const RayCastTables& tables = request.Tables;
  if (this->PropertyVersion != tables.Property.GetVersion())
  {
    this->UpdateProperty(tables.Property);
    this->PropertyVersion = tables.Property.GetVersion();
  }
  for (const RayCastTableState& wanted : tables.ListWanted(request.Frame))
  {
    this->Counter.Count(wanted, this->SizeOf(wanted.Table, tables));
  }
  return std::string();
}

//------------------------------------------------------------------------------
/** Bytes of a table that this backend reads; the transfer function's are in a form of its own. */
std::int64_t RayCastNative::SizeOf(RayCastTable table, const RayCastTables& tables) const
{
  const VolumeInput& input = tables.Input;
  const TetrahedralMesh& mesh = input.GetMesh();
  switch (table)
  {
    case RayCastTable::Cells:
      return TableCounter::SizeOf(mesh.GetCells());
    case RayCastTable::Boundary:
      return TableCounter::SizeOf(mesh.GetBoundary());
    case RayCastTable::Vertices:
      return TableCounter::SizeOf(mesh.GetFixedPositions()) +
        TableCounter::SizeOf(input.GetScalars());
    case RayCastTable::CellScalars:
      return TableCounter::SizeOf(input.GetCellScalars());
    case RayCastTable::VertexGradients:
      return TableCounter::SizeOf(tables.VertexGradients.GetValues());
    case RayCastTable::CellGradients:
      return TableCounter::SizeOf(tables.CellGradients.GetValues());
    case RayCastTable::Components:
      return TableCounter::SizeOf(tables.Components.GetValues());
    case RayCastTable::Functions:
      return this->GetPropertyBytes();
    case RayCastTable::PreIntegration:
      return TableCounter::SizeOf(tables.PreIntegration.GetTable().GetValues());
    case RayCastTable::RefractedRays:
      return tables.Membrane.GetSightBytes();
    default:
      return 0;
  }
}

//------------------------------------------------------------------------------
TileCaster::Scene RayCastNative::MakeScene(const RayCastRequest& request)
{
  RayCastTables& tables = request.Tables;
  const RayCastFrame& frame = request.Frame;
  const RayCastOptics& optics = frame.Optics;
  TileCaster::Scene scene;
  scene.Mesh = &tables.Input.GetMesh();
  scene.Boundary = &scene.Mesh->GetBoundary();
  scene.Tables = &this->Tables;
  scene.Set = this->Set;
  scene.CellScalars = optics.CellScalars ? tables.Input.GetCellScalars().data() : nullptr;
  scene.Lighting = optics.Shading ? &optics.Lighting : nullptr;
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
  return scene;
}

//------------------------------------------------------------------------------
std::string RayCastNative::Cast(const RayCastRequest& request, RayCastTarget& target)
{
  TileCaster::Scene scene = this->MakeScene(request);
  scene.Rays = FixedPointRays(request.Frame.Rays, target.GetWidth(), target.GetHeight());
  const VolumeInput& input = request.Tables.Input;
  const TableVersions versions{ input.GetMeshVersion(), input.GetScalarVersion() };
  if (versions != this->PlacedVersions || !scene.Rays.PlacesAs(this->PlacedBy))
  {
    PlaceVertices(
      input.GetMesh(), input.GetScalars(), scene.Rays, ThreadedLoop, this->Tables.Vertices);
    this->PlacedBy = scene.Rays;
    this->PlacedVersions = versions;
  }
  this->CastTiles(scene, target.ReadDepths(), target.GetDepthsOfImage());
  return target.WriteImage(this->Image, this->Filled);
}

//------------------------------------------------------------------------------
void RayCastNative::CastTiles(const TileCaster::Scene& scene, const std::vector<float>& depths,
  const std::vector<float>* before)
{
  const TileCaster caster(scene, ThreadedLoop);
  const int width = scene.Rays.GetWidth();
  if (this->Image.size() != 4 * depths.size() || this->ImageWidth != width)
  {
    this->Image.assign(4 * depths.size(), 0.0f);
    this->ImageWidth = width;
    this->OfTile.assign(static_cast<std::size_t>(caster.GetNumberOfTiles()), RayStatistics());
  }
  vtkSMPThreadLocal<TileCaster::Workspace> workspaces;
  std::atomic<std::int64_t> pixels{ 0 };
  // Tiles differ in cost: small grains let threads share it.
  vtkSMPTools::For(0, caster.GetNumberOfTiles(), 1,
    [&](vtkIdType first, vtkIdType last)
    {
      TileCaster::Workspace& workspace = workspaces.Local();
      for (vtkIdType tile = first; tile < last; ++tile)
      {
        const BoundaryRaster::PixelBox box = caster.GetBox(static_cast<int>(tile));
        if (before && HaveEqualRows(box, width, *before, depths))
        {
          continue;
        }
        RayStatistics& sums = this->OfTile[static_cast<std::size_t>(tile)];
        if (IsFilled(sums))
        {
          ClearRows(box, width, this->Image);
        }
        sums = caster.Cast(static_cast<int>(tile), depths.data(), this->Image.data(), workspace);
        pixels += std::int64_t{ box.Right - box.Left } * (box.Top - box.Bottom);
      }
    });
  this->CastPixels += pixels;
  this->BoundFilled(caster);
}

//------------------------------------------------------------------------------
/** Sets the box around all tiles with rays that met the mesh. */
void RayCastNative::BoundFilled(const TileCaster& caster)
{
  this->Filled = { caster.GetWidth(), 0, caster.GetHeight(), 0 };
  for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
  {
    if (IsFilled(this->OfTile[static_cast<std::size_t>(tile)]))
    {
      const BoundaryRaster::PixelBox box = caster.GetBox(tile);
      this->Filled = { std::min(this->Filled.Left, box.Left),
        std::max(this->Filled.Right, box.Right), std::min(this->Filled.Bottom, box.Bottom),
        std::max(this->Filled.Top, box.Top) };
    }
  }
}

//------------------------------------------------------------------------------
RayCastStatistics RayCastNative::GetStatistics()
{
  RayCastStatistics total;
  for (const RayStatistics& tile : this->OfTile)
  {
    total.Steps += tile.Steps;
    total.Rays += tile.Rays;
    total.Lost += tile.Lost;
  }
  return total;
}

//------------------------------------------------------------------------------
RayCastCounters RayCastNative::GetCounters()
{
  RayCastCounters counters;
  counters.UploadedBytes = this->Counter.GetBytes();
  counters.HostBytes =
    BytesOf(this->Tables.Vertices) + BytesOf(this->Image) + this->GetPropertyBytes();
  counters.CastPixels = this->CastPixels;
  return counters;
}

//------------------------------------------------------------------------------
std::unique_ptr<RayCastBackend> MakeNativeBackend(RayCastSharing&)
{
  return std::make_unique<RayCastNative>();
}

}
