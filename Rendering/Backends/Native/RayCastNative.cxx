// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/RayCastNative.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"

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
  const TileCaster::Scene scene =
    this->Scene.Make(request.Tables, request.Frame, target.GetWidth(), target.GetHeight());
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
    total.Overlaps += tile.Overlaps;
  }
  return total;
}

//------------------------------------------------------------------------------
RayCastCounters RayCastNative::GetCounters()
{
  RayCastCounters counters;
  counters.UploadedBytes = this->Counter.GetBytes();
  counters.HostBytes =
    this->Scene.GetVertexBytes() + BytesOf(this->Image) + this->Scene.GetPropertyBytes();
  counters.CastPixels = this->CastPixels;
  return counters;
}

//------------------------------------------------------------------------------
std::unique_ptr<RayCastBackend> MakeNativeBackend(RayCastSharing&)
{
  return std::make_unique<RayCastNative>();
}

}
