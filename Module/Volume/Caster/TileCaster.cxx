// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/TileCaster.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Kernels/PacketKernels.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
TileCaster::TileCaster(const Scene& scene)
  : Input(scene)
{
  this->Raster.Build(scene.Tables->Vertices, *scene.Boundary, scene.Rays, scene.Set);
  this->Medium.Pack(scene.Lighting, scene.GradientToFrame, scene.GradientMagnitude,
    scene.GradientOpacity ? &scene.Tables->GradientIntervals : nullptr);
  if (scene.PreIntegration)
  {
    const PreIntegrationTable& table = *scene.PreIntegration;
    this->SegmentTable = { table.GetValues().data(), table.GetNumberOfScalars(),
      table.GetNumberOfLengths(), static_cast<float>(1.0 / table.GetShortest()),
      static_cast<float>(table.GetLengthsPerOctave()), static_cast<float>(table.GetMiddle()),
      static_cast<float>(table.GetPerHalfRange()) };
  }
  if (scene.Refracted.Sight)
  {
    this->Refracted = std::make_unique<RefractedRayCaster>(scene.Refracted, *scene.Mesh,
      this->Input.Rays, this->Input.ClippingPlanes,
      RefractedOptics{ scene.Lighting, scene.GradientToFrame, scene.GradientMagnitude,
        scene.GradientOpacity ? &scene.Tables->GradientIntervals : nullptr },
      scene.Set);
  }
}

//------------------------------------------------------------------------------
/** @param farthest largest depth at which the ray may end. */
PacketRay TileCaster::RayOf(int column, int row, const float* opaqueDepth, double farthest) const
{
  const FixedPointRays& rays = this->Input.Rays;
  const RayFrame& frame = rays.GetFrame();
  const std::int64_t pixel = std::int64_t{ row } * rays.GetWidth() + column;
  double start = frame.NearDepth;
  double end = opaqueDepth ? frame.DepthAt(2.0 * opaqueDepth[pixel] - 1.0) : 1.0e+30;
  end = std::min(end, farthest);
  for (const RayClippingPlane& plane : this->Input.ClippingPlanes)
  {
    ClipRay(plane, rays.FromCenter(column, row), start, end);
  }
  PacketRay ray = rays.RayOf(column, row);
  ray.StartDepth = rays.FromPivot(start);
  ray.EndDepth = rays.FromPivot(end);
  return ray;
}

//------------------------------------------------------------------------------
/** Sets up a ray for each pixel with an entry and a non-empty depth range. */
void TileCaster::TakeRays(
  int tile, const float* opaqueDepth, const RefractedRay* refracted, Workspace& workspace) const
{
  const BoundaryRaster::PixelBox box = this->Raster.BoxOfTile(tile);
  const EntryLists& entries = workspace.Entries.Lists;
  for (int number = 0; number < BoundaryRaster::TileSize * BoundaryRaster::TileSize; ++number)
  {
    const auto inTile = static_cast<std::size_t>(number);
    if (entries.GetBegin(inTile) == entries.GetBegin(inTile + 1))
    {
      continue;
    }
    const int column = box.Left + number % BoundaryRaster::TileSize;
    const int row = box.Bottom + number / BoundaryRaster::TileSize;
    PacketRay ray =
      this->RayOf(column, row, opaqueDepth, refracted ? refracted[number].Depth : 1.0e+30);
    if (ray.StartDepth < ray.EndDepth)
    {
      ray.FirstEntry = entries.GetBegin(inTile);
      ray.EndEntry = entries.GetBegin(inTile + 1);
      workspace.Pixels.push_back(std::int64_t{ row } * this->Input.Rays.GetWidth() + column);
      workspace.Rays.push_back(ray);
    }
    else if (refracted)
    {
      // The sight point may be inside the mesh all the same.
      workspace.Refracted.Straight.Ends[inTile] = PacketResult::Somewhere;
    }
  }
}

//------------------------------------------------------------------------------
/** Sets the tables that map scalars to colours. */
void TileCaster::SetOptics(PacketJob& job) const
{
  const PacketTables& tables = *this->Input.Tables;
  const auto sizeOf = [](const auto& table) { return static_cast<std::int32_t>(table.size()); };
  job.Blending = this->Input.Blending;
  job.CellScalars = this->Input.CellScalars;
  job.Surfaces = tables.Surfaces.data();
  job.NumberOfSurfaces = sizeOf(tables.Surfaces);
  job.Lighting = this->Input.Lighting;
  job.VertexGradients = this->Input.VertexGradients ? &this->Input.VertexGradients->x : nullptr;
  job.CellGradients = this->Input.CellGradients ? &this->Input.CellGradients->x : nullptr;
  job.GradientToFrame = &this->Input.GradientToFrame;
  job.Intervals = tables.Intervals.data();
  job.NumberOfIntervals = sizeOf(tables.Intervals);
  job.TerminationTransmittance = this->Input.TerminationTransmittance;
  const ScalarRange& range = this->Input.DataRange;
  job.SharePerScalar = static_cast<float>(1.0 / (range.Highest - range.Lowest));
  job.ShareAtZero = static_cast<float>(-range.Lowest / (range.Highest - range.Lowest));
  job.Mixture = this->Input.Mixture;
  job.Components = this->Input.Components ? &this->Input.Components->x : nullptr;
  for (std::size_t i = 0; i < tables.OtherIntervals.size(); ++i)
  {
    job.OtherIntervals[i] = tables.OtherIntervals[i].data();
    job.NumberOfOtherIntervals[i] = sizeOf(tables.OtherIntervals[i]);
  }
  job.SegmentTable = this->Input.PreIntegration ? &this->SegmentTable : nullptr;
  job.Medium = GetBlendModel(job.Blending).IsMedium() ? this->Medium.Get() : nullptr;
}

//------------------------------------------------------------------------------
/** Casts the rays of the workspace. */
void TileCaster::CastStraight(PacketJob& job, Workspace& workspace) const
{
  workspace.Results.resize(workspace.Rays.size());
  if (workspace.Rays.empty())
  {
    return;
  }
  job.Rays = workspace.Rays.data();
  job.NumberOfRays = static_cast<std::int32_t>(workspace.Rays.size());
  job.Entries = workspace.Entries.Lists.GetEntries().data();
  job.Results = workspace.Results.data();
  CastPackets(job, this->Input.Set);
}

//------------------------------------------------------------------------------
RayStatistics TileCaster::ShowStraight(const Workspace& workspace, float* image) const
{
  RayStatistics sums;
  for (std::size_t i = 0; i < workspace.Results.size(); ++i)
  {
    const PacketResult& result = workspace.Results[i];
    std::copy_n(result.Color, 4, image + 4 * workspace.Pixels[i]);
    sums.Steps += result.Steps;
    sums.Rays += result.Steps > 0 ? 1 : 0;
    sums.Lost += result.Lost;
  }
  return sums;
}

//------------------------------------------------------------------------------
/** Stores the results for the refracted part of the rays. */
void TileCaster::KeepStraight(int tile, const RefractedRay* refracted, Workspace& workspace) const
{
  const BoundaryRaster::PixelBox box = this->Raster.BoxOfTile(tile);
  StraightPart& straight = workspace.Refracted.Straight;
  const int width = this->Input.Rays.GetWidth();
  for (std::size_t i = 0; i < workspace.Results.size(); ++i)
  {
    const PacketResult& result = workspace.Results[i];
    const auto column = static_cast<int>(workspace.Pixels[i] % width) - box.Left;
    const auto row = static_cast<int>(workspace.Pixels[i] / width) - box.Bottom;
    const auto pixel = static_cast<std::size_t>(row * BoundaryRaster::TileSize + column);
    std::copy_n(result.Color, 4, straight.Values[pixel].data());
    straight.Steps[pixel] = result.Steps;
    // A ray that ended at a clipping plane gives no information about the sight point.
    const bool arrived =
      workspace.Rays[i].EndDepth == this->Input.Rays.FromPivot(refracted[pixel].Depth);
    straight.Ends[pixel] = arrived ? result.End : PacketResult::Somewhere;
  }
}

//------------------------------------------------------------------------------
/** True if a ray of the tile may enter the mesh in front of the membrane. */
bool TileCaster::IsMeshInFront(int tile, const RefractedRay* refracted) const
{
  const BoundaryRaster::PixelBox box = this->Raster.BoxOfTile(tile);
  const FixedPointRays& rays = this->Input.Rays;
  const float nearest = rays.FromPivot(this->Raster.NearestDepth(tile));
  for (int row = 0; row < box.Top - box.Bottom; ++row)
  {
    for (int column = 0; column < box.Right - box.Left; ++column)
    {
      // An entry is used if it is before the end, both in single precision.
      const double depth = refracted[row * BoundaryRaster::TileSize + column].Depth;
      if (nearest < rays.FromPivot(depth))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
RayStatistics TileCaster::Cast(
  int tile, const float* opaqueDepth, float* image, Workspace& workspace) const
{
  const RefractedRay* refracted =
    this->Refracted ? this->Input.Refracted.Sight->GetTile(tile) : nullptr;
  const bool behindOnly = this->Input.Refracted.Part == MembranePart::Behind;
  if (behindOnly && !refracted)
  {
    return RayStatistics();
  }
  if (refracted)
  {
    // Rays that are not cast give no information about the sight point.
    workspace.Refracted.Straight.Clear(
      this->Input.Blending, behindOnly ? PacketResult::Somewhere : PacketResult::Outside);
  }
  const bool straight = !refracted || (!behindOnly && this->IsMeshInFront(tile, refracted));
  if (!straight && this->Input.Refracted.Part == MembranePart::InFront)
  {
    return RayStatistics();
  }
  workspace.Rays.clear();
  workspace.Pixels.clear();
  if (straight)
  {
    this->Raster.CollectEntries(tile, workspace.Entries);
    this->TakeRays(tile, opaqueDepth, refracted, workspace);
  }
  const TetrahedralMesh& mesh = *this->Input.Mesh;
  PacketJob job{};
  this->SetOptics(job);
  job.GridUnit = this->Input.Rays.GetGridUnit();
  job.Pivot = this->Input.Rays.GetPivot();
  job.Vertices = this->Input.Tables->Vertices.data();
  job.Cells = mesh.GetCells().front().Vertices.data();
  job.NumberOfCells = mesh.GetNumberOfCells();
  job.KeepsValues = refracted != nullptr;
  this->CastStraight(job, workspace);
  if (!refracted)
  {
    return this->ShowStraight(workspace, image);
  }
  std::int64_t lost = 0;
  for (const PacketResult& result : workspace.Results)
  {
    lost += result.Lost;
  }
  this->KeepStraight(tile, refracted, workspace);
  RayStatistics sums = this->Refracted->Cast(
    job, this->Raster.BoxOfTile(tile), refracted, opaqueDepth, workspace.Refracted, image);
  sums.Lost += lost;
  return sums;
}

}
