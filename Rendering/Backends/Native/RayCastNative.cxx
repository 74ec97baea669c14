// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/RayCastNative.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"

#include "vtkSMPThreadLocal.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace meniscus
{
namespace
{

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
std::string RayCastNative::Update(const RayCastRequest& request)
{
  const RayCastTables& tables = request.Tables;
  this->Scene.UpdateProperty(tables.Property);
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
    case RayCastTable::Illumination:
      return TableCounter::SizeOf(tables.Illumination.GetValues());
    case RayCastTable::Functions:
      return this->Scene.GetPropertyBytes();
    case RayCastTable::PreIntegration:
      return TableCounter::SizeOf(tables.PreIntegration.GetTable().GetValues());
    case RayCastTable::RefractedRays:
      return tables.Membrane.GetSightBytes();
    default:
      return 0;
  }
}

//------------------------------------------------------------------------------
std::string RayCastNative::Cast(const RayCastRequest& request, RayCastTarget& target)
{
  const int width = target.GetWidth();
  const int height = target.GetHeight();
  const ImageDepths depths{ target.ReadDepths(), target.GetDepthsOfImage() };
  TileCaster::Scene scene = this->Scene.Make(request.Tables, request.Frame, width, height);
  scene.Interpolating = request.Frame.Output.Interpolating;
  const TileCaster caster(scene, ThreadedLoop);
  if (!this->CastTiles(caster, depths, target))
  {
    this->Refined.Forget();
    return std::string();
  }
  const int across = request.Frame.Output.RaysAcross;
  if (across == 1 || !this->CastsSeveralRays(request))
  {
    this->Refined.Clear();
    const BoundaryRaster::PixelBox& box = this->Filled;
    return target.WriteImage(this->Image, { box.Left, box.Right, box.Bottom, box.Top });
  }
  const bool finished = this->Refined.Refine(this->Image, width, this->Filled,
    SumOf(this->OfTile).Rays, across, depths, target,
    [&]()
    {
      TileCaster::Scene refined =
        this->Scene.Make(request.Tables, request.Frame, width, height, across);
      refined.Refining.Coarse = &caster.GetRaster();
      return refined;
    });
  return finished ? target.WriteImage(this->Refined.GetPixels(), this->Refined.GetFilled())
                  : std::string();
}

//------------------------------------------------------------------------------
/** Behind a membrane, rays between pixels would have to be refracted. */
bool RayCastNative::CastsSeveralRays(const RayCastRequest& request) const
{
  return !request.Frame.Refracting.Met;
}

//------------------------------------------------------------------------------
/**
 * Casts the image, or the tiles of it that are left or in which a depth has changed. Returns false
 * if the application gives up the frame.
 */
bool RayCastNative::CastTiles(
  const TileCaster& caster, const ImageDepths& depths, RayCastTarget& target)
{
  const int width = caster.GetWidth();
  if (this->Image.size() != 4 * depths.Now.size() || this->ImageWidth != width)
  {
    this->Image.assign(4 * depths.Now.size(), 0.0f);
    this->ImageWidth = width;
    this->OfTile.assign(static_cast<std::size_t>(caster.GetNumberOfTiles()), RayStatistics());
  }
  this->Tiles.Begin(caster.GetNumberOfTiles(), depths.Before != nullptr,
    [&](int tile) { return depths.AreThoseBefore(caster.GetBox(tile), width); });
  vtkSMPThreadLocal<TileCaster::Workspace> workspaces;
  std::atomic<std::int64_t> pixels{ 0 };
  const bool finished = this->Tiles.Cast(target,
    [&](int tile)
    {
      const BoundaryRaster::PixelBox box = caster.GetBox(tile);
      RayStatistics& sums = this->OfTile[static_cast<std::size_t>(tile)];
      if (IsFilled(sums))
      {
        ClearRows(box, width, this->Image);
      }
      sums = caster.Cast(tile, depths.Now.data(), this->Image.data(), workspaces.Local());
      pixels += std::int64_t{ box.Right - box.Left } * (box.Top - box.Bottom);
    });
  this->CastPixels += pixels;
  this->BoundFilled(caster);
  return finished;
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
  const RayStatistics sum = SumOf(this->OfTile);
  RayCastStatistics total;
  total.Steps = sum.Steps;
  total.Rays = sum.Rays;
  total.Lost = sum.Lost;
  total.Overlaps = sum.Overlaps;
  total.Interpolated = sum.Interpolated;
  this->Refined.AddTo(total);
  return total;
}

//------------------------------------------------------------------------------
RayCastCounters RayCastNative::GetCounters()
{
  RayCastCounters counters;
  counters.UploadedBytes = this->Counter.GetBytes();
  counters.HostBytes = this->Scene.GetVertexBytes() + BytesOf(this->Image) +
    this->Refined.GetBytes() + this->Scene.GetPropertyBytes();
  counters.CastPixels = this->CastPixels;
  return counters;
}

//------------------------------------------------------------------------------
std::unique_ptr<RayCastBackend> MakeNativeBackend(RayCastSharing&)
{
  return std::make_unique<RayCastNative>();
}

}
