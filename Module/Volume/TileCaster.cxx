// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/TileCaster.h"

#include "Volume/BlockLoop.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
void PlaceVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars,
  const PixelRays& rays, const RangeLoop& loop, std::vector<PacketVertex>& vertices)
{
  vertices.resize(mesh.GetFixedPositions().size());
  ForEachBlock(vertices.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t v = first; v < last; ++v)
      {
        const glm::ivec3 place = rays.Place(mesh.GetFixedPositions()[v]);
        vertices[v] = { { place.x, place.y, place.z }, scalars.empty() ? 0.0f : scalars[v] };
      }
    });
}

//------------------------------------------------------------------------------
std::vector<PacketInterval> PackIntervals(const std::vector<TransferFunctionInterval>& intervals)
{
  std::vector<PacketInterval> packed;
  packed.reserve(intervals.size());
  for (const TransferFunctionInterval& interval : intervals)
  {
    const glm::vec3& color = interval.Color;
    const glm::vec3& slope = interval.ColorSlope;
    packed.push_back(
      { interval.Lower, interval.Upper, interval.Attenuation, interval.AttenuationSlope,
        { color.r, color.g, color.b, 0.0f }, { slope.r, slope.g, slope.b, 0.0f } });
  }
  return packed;
}

//------------------------------------------------------------------------------
TileCaster::TileCaster(const Scene& scene)
  : Input(scene)
{
  this->Raster.Build(scene.Tables->Vertices, *scene.Boundary, scene.Rays);
  this->Medium.Pack(scene.Lighting, scene.GradientToFrame, scene.GradientMagnitude,
    scene.GradientOpacity ? &scene.Tables->GradientIntervals : nullptr);
  if (scene.PreIntegration)
  {
    const PreIntegrationTable& table = *scene.PreIntegration;
    this->SegmentTable = { table.GetValues().data(), table.GetNumberOfScalars(),
      table.GetNumberOfLengths(), static_cast<float>(1.0 / table.GetShortest()),
      static_cast<float>(table.GetLengthsPerOctave()) };
  }
}

//------------------------------------------------------------------------------
PacketRay TileCaster::RayOf(int column, int row, const float* opaqueDepth) const
{
  const PixelRays& rays = this->Input.Rays;
  const RayFrame& frame = rays.GetFrame();
  const std::int64_t pixel = std::int64_t{ row } * rays.GetWidth() + column;
  double start = frame.NearDepth;
  double end = opaqueDepth ? frame.DepthAt(2.0 * opaqueDepth[pixel] - 1.0) : 1.0e+30;
  for (const RayClippingPlane& plane : this->Input.ClippingPlanes)
  {
    ClipRay(plane, rays.FromCenter(column, row), start, end);
  }
  PacketRay ray = rays.RayOf(column, row);
  ray.StartDepth = static_cast<float>(start);
  ray.EndDepth = static_cast<float>(end);
  return ray;
}

//------------------------------------------------------------------------------
/** One ray for each pixel with a hit and a part that counts. */
void TileCaster::TakeHits(int tile, const float* opaqueDepth, Workspace& workspace) const
{
  const EntryRaster::PixelBox box = this->Raster.BoxOfTile(tile);
  workspace.Entries.clear();
  workspace.Rays.clear();
  workspace.Pixels.clear();
  std::int32_t lastPixel = -1;
  bool counts = false;
  for (const EntryRaster::Hit& hit : workspace.Hits)
  {
    if (hit.Pixel != lastPixel)
    {
      lastPixel = hit.Pixel;
      const int column = box.Left + hit.Pixel % EntryRaster::TileSize;
      const int row = box.Bottom + hit.Pixel / EntryRaster::TileSize;
      const std::int64_t pixel = std::int64_t{ row } * this->Input.Rays.GetWidth() + column;
      const PacketRay ray = this->RayOf(column, row, opaqueDepth);
      counts = ray.StartDepth < ray.EndDepth;
      if (counts)
      {
        workspace.Pixels.push_back(pixel);
        workspace.Rays.push_back(ray);
        workspace.Rays.back().FirstEntry = static_cast<std::int32_t>(workspace.Entries.size());
      }
    }
    if (counts)
    {
      workspace.Entries.push_back(hit.Entry);
      workspace.Rays.back().EndEntry = static_cast<std::int32_t>(workspace.Entries.size());
    }
  }
}

//------------------------------------------------------------------------------
/** What becomes of scalars. */
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
  job.GradientToFrame = &this->Input.GradientToFrame;
  job.Intervals = tables.Intervals.data();
  job.NumberOfIntervals = sizeOf(tables.Intervals);
  job.TerminationTransmittance = this->Input.TerminationTransmittance;
  job.Mixture = this->Input.Mixture;
  job.Components = this->Input.Components ? &this->Input.Components->x : nullptr;
  for (std::size_t i = 0; i < tables.OtherIntervals.size(); ++i)
  {
    job.OtherIntervals[i] = tables.OtherIntervals[i].data();
    job.NumberOfOtherIntervals[i] = sizeOf(tables.OtherIntervals[i]);
  }
  job.SegmentTable = this->Input.PreIntegration ? &this->SegmentTable : nullptr;
  job.Medium = job.Blending == PacketBlending::Composite ? this->Medium.Get() : nullptr;
}

//------------------------------------------------------------------------------
RayStatistics TileCaster::Cast(
  int tile, const float* opaqueDepth, float* image, Workspace& workspace) const
{
  this->Raster.CollectHits(tile, workspace.Hits);
  this->TakeHits(tile, opaqueDepth, workspace);
  RayStatistics sums;
  if (workspace.Rays.empty())
  {
    return sums;
  }
  workspace.Results.resize(workspace.Rays.size());
  const TetrahedralMesh& mesh = *this->Input.Mesh;
  PacketJob job{};
  this->SetOptics(job);
  job.GridUnit = this->Input.Rays.GetGridUnit();
  job.Vertices = this->Input.Tables->Vertices.data();
  job.Cells = mesh.GetCells().front().Vertices.data();
  job.NumberOfCells = mesh.GetNumberOfCells();
  job.Rays = workspace.Rays.data();
  job.NumberOfRays = static_cast<std::int32_t>(workspace.Rays.size());
  job.Entries = workspace.Entries.data();
  job.Results = workspace.Results.data();
  CastPackets(job, this->Input.Set);
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

}
