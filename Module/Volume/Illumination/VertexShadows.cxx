// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/VertexShadows.h"

#include "Volume/Caster/LegFrame.h"
#include "Volume/Entries/EntryLists.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Kernels/PacketKernels.h"
#include "Volume/Refracted/RayBundleEntries.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>

namespace meniscus
{
namespace
{

/** Lines that are cast together: 8 blocks. */
constexpr std::size_t BatchSize = 8 * LineBlock::Size;

/** A line in its frame. */
struct ShadowLine
{
  /** Frame; negative if the transmittance is 1 without a cast. */
  int Frame = -1;
  FrameLine Line{};
  /** Depths of the start at the vertex, and of the part that is cast. */
  double Place = 0.0;
  double Begin = 0.0;
  double End = 0.0;
};

/** Lines of one frame that are being cast, with buffers. */
struct ShadowBatch
{
  std::array<LineBlock, BatchSize / LineBlock::Size> Blocks;
  std::size_t Count = 0;
  std::vector<std::int32_t> Vertices;
  /** Entries in the cells at the vertices, and the lines that have one. */
  std::vector<std::pair<std::int32_t, PacketEntry>> Inside;
  RayBundleEntries::Workspace Found;
  EntryLists Entries;
  std::vector<PacketRay> Rays;
  std::vector<std::int32_t> RayVertices;
  std::vector<PacketResult> Results;
  /** Vertices whose lines are cast again, from the boundary. */
  std::vector<std::int32_t> Again;
  RayStatistics Sums;

  void Clear()
  {
    this->Count = 0;
    this->Vertices.clear();
    this->Inside.clear();
    for (LineBlock& block : this->Blocks)
    {
      block.Count = 0;
    }
  }
};

/** Casts lines of one frame. */
struct FrameCaster
{
  FrameCaster(const ShadowScene& scene, const RefractionFrame& frame)
    : Frame(frame)
    , Entries(*scene.Medium.Mesh, *scene.Tree, frame, scene.Medium.Set)
  {
    const TileCaster::Scene& medium = scene.Medium;
    this->Leg.Set(frame.Rays, frame.Vertices,
      { nullptr, frame.FromView * medium.GradientToFrame, medium.GradientMagnitude,
        medium.GradientOpacity ? &medium.Tables->GradientIntervals : nullptr });
  }

  const RefractionFrame& Frame;
  RayBundleEntries Entries;
  LegFrame Leg;
};

class ShadowCast
{
public:
  ShadowCast(const ShadowScene& scene, const glm::dvec4& light, const RangeLoop& loop,
    const ShadowTaker& take);

  /** Casts the lines of the vertices [first, last) of the starts. */
  RayStatistics Cast(std::size_t first, std::size_t last, ShadowBatch& batch) const;

private:
  ShadowLine LineOf(std::int32_t vertex) const;
  void Add(
    std::int32_t vertex, const ShadowLine& line, bool fromBoundary, ShadowBatch& batch) const;
  void FindRays(const FrameCaster& caster, ShadowBatch& batch) const;
  void CastLines(const FrameCaster& caster, ShadowBatch& batch) const;

  const ShadowScene& Scene;
  const ShadowTaker& Take;
  LightFrames Frames;
  /** One per frame; null if it has no lines. */
  std::vector<std::unique_ptr<FrameCaster>> Casters;
};

//------------------------------------------------------------------------------
ShadowCast::ShadowCast(
  const ShadowScene& scene, const glm::dvec4& light, const RangeLoop& loop, const ShadowTaker& take)
  : Scene(scene)
  , Take(take)
{
  this->Frames.Set(scene.Base, light);
  this->Frames.Place(*scene.Medium.Mesh, *scene.Scalars, *scene.Starts, loop);
  for (int index = 0; index < this->Frames.GetNumberOfFrames(); ++index)
  {
    this->Casters.push_back(this->Frames.IsNeeded(index)
        ? std::make_unique<FrameCaster>(scene, this->Frames.Get(index))
        : nullptr);
  }
}

//------------------------------------------------------------------------------
ShadowLine ShadowCast::LineOf(std::int32_t vertex) const
{
  ShadowLine line;
  const glm::dvec3 place = this->Frames.ToBaseFrame(this->Scene.Starts->GetPlace(vertex));
  const glm::dvec3 step = this->Frames.StepFrom(place);
  const double distance = glm::length(step);
  double begin = 0.0;
  double end = this->Scene.Reach;
  if (!this->Frames.IsParallel())
  {
    end = std::min(end, distance);
  }
  const glm::dvec3 along = step / distance;
  for (const RayClippingPlane& plane : this->Scene.Medium.ClippingPlanes)
  {
    ClipLine(plane, place, along, begin, end);
  }
  // A light at the vertex has no direction, and no way to it.
  if (!(begin < end) || !(distance > 0.0))
  {
    return line;
  }
  line.Frame = this->Frames.IndexOf(step);
  const RefractionFrame& frame = this->Frames.Get(line.Frame);
  const glm::dvec3 inFrame = frame.FromView * place;
  const glm::dvec3 direction = frame.FromView * along;
  line.Line = this->Frames.IsParallel() ? FrameLine{ glm::dvec2(inFrame), glm::dvec2(0.0) }
                                        : FrameLine::Through(inFrame, direction);
  line.Place = inFrame.z;
  line.Begin = inFrame.z + begin * direction.z;
  line.End = inFrame.z + end * direction.z;
  return line;
}

//------------------------------------------------------------------------------
/** Adds a line to the batch, with its entry into the cell at the vertex. */
void ShadowCast::Add(
  std::int32_t vertex, const ShadowLine& line, bool fromBoundary, ShadowBatch& batch) const
{
  const FrameCaster& caster = *this->Casters[static_cast<std::size_t>(line.Frame)];
  const FixedPointRays& rays = caster.Frame.Rays;
  LineBlock& block = batch.Blocks[batch.Count / LineBlock::Size];
  const int i = block.Count++;
  PacketRay ray = rays.RayAlong(line.Line.Origin, line.Line.Slope);
  ray.StartDepth = rays.FromPivot(line.Begin);
  ray.EndDepth = rays.FromPivot(line.End);
  block.SetRay(i, ray);
  for (int axis = 0; axis < 2; ++axis)
  {
    block.Origin[axis][i] = line.Line.Origin[axis];
    block.Slope[axis][i] = line.Line.Slope[axis];
  }
  PacketEntry entry;
  const bool isInside = !fromBoundary && this->Scene.Starts->AreInside() &&
    caster.Entries.EntersCell(this->Scene.Starts->GetCell(vertex), ray, line.Place, entry);
  block.From[i] = isInside ? line.Place : -caster.Frame.Extent;
  if (isInside)
  {
    batch.Inside.emplace_back(static_cast<std::int32_t>(batch.Count), entry);
  }
  batch.Vertices.push_back(vertex);
  ++batch.Count;
}

//------------------------------------------------------------------------------
/** Sets the rays of the batch's lines that enter the mesh. Others meet nothing. */
void ShadowCast::FindRays(const FrameCaster& caster, ShadowBatch& batch) const
{
  const std::size_t blocks = (batch.Count + LineBlock::Size - 1) / LineBlock::Size;
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t line = 0; line < batch.Count; ++line)
  {
    const float end = batch.Blocks[line / LineBlock::Size].EndDepth[line % LineBlock::Size];
    last = std::max(last, caster.Frame.Rays.ToFrame(end));
  }
  caster.Entries.Collect(batch.Blocks.data(), blocks, batch.Found, last);
  for (const auto& inside : batch.Inside)
  {
    batch.Found.Add(inside.first, inside.second);
  }
  batch.Entries.Set(LineBlock::Size * blocks, batch.Found.Hits.data(), batch.Found.NumberOfHits,
    batch.Found.Faces.data());
  batch.Rays.clear();
  batch.RayVertices.clear();
  for (std::size_t line = 0; line < batch.Count; ++line)
  {
    const std::int32_t begin = batch.Entries.GetBegin(line);
    const std::int32_t end = batch.Entries.GetBegin(line + 1);
    if (begin == end)
    {
      this->Take(batch.Vertices[line], 1.0f);
      continue;
    }
    batch.Rays.push_back(
      batch.Blocks[line / LineBlock::Size].GetRay(static_cast<int>(line % LineBlock::Size)));
    batch.Rays.back().FirstEntry = begin;
    batch.Rays.back().EndEntry = end;
    batch.RayVertices.push_back(batch.Vertices[line]);
  }
}

//------------------------------------------------------------------------------
void ShadowCast::CastLines(const FrameCaster& caster, ShadowBatch& batch) const
{
  this->FindRays(caster, batch);
  batch.Results.resize(batch.Rays.size());
  PacketJob job{};
  TileCaster::SetOptics(this->Scene.Medium, job);
  job.TerminationTransmittance = OpaqueShadow;
  job.KeepsValues = true;
  caster.Leg.Describe(job);
  job.Rays = batch.Rays.data();
  job.NumberOfRays = static_cast<std::int32_t>(batch.Rays.size());
  job.Entries = batch.Entries.GetEntries().data();
  job.Results = batch.Results.data();
  CastPackets(job, this->Scene.Medium.Set);
  const std::size_t inside = batch.Inside.size();
  for (std::size_t i = 0; i < batch.Results.size(); ++i)
  {
    const PacketResult& result = batch.Results[i];
    batch.Sums.Steps += result.Steps;
    ++batch.Sums.Rays;
    if (result.Lost != 0 && inside > 0)
    {
      batch.Again.push_back(batch.RayVertices[i]);
      continue;
    }
    batch.Sums.Lost += result.Lost;
    this->Take(batch.RayVertices[i], result.Color[3]);
  }
}

//------------------------------------------------------------------------------
RayStatistics ShadowCast::Cast(std::size_t first, std::size_t last, ShadowBatch& batch) const
{
  const std::vector<std::int32_t>& vertices = this->Scene.Starts->GetVertices();
  batch.Sums = RayStatistics();
  for (int frame = -1; frame < this->Frames.GetNumberOfFrames(); ++frame)
  {
    if (frame >= 0 && !this->Casters[static_cast<std::size_t>(frame)])
    {
      continue;
    }
    batch.Clear();
    for (std::size_t i = first; i < last; ++i)
    {
      const ShadowLine line = this->LineOf(vertices[i]);
      if (line.Frame != frame)
      {
        continue;
      }
      if (frame < 0)
      {
        this->Take(vertices[i], 1.0f);
      }
      else
      {
        this->Add(vertices[i], line, false, batch);
      }
    }
    if (batch.Count > 0)
    {
      this->CastLines(*this->Casters[static_cast<std::size_t>(frame)], batch);
    }
  }
  // Lines that cells inverted by rounding led around.
  std::vector<std::int32_t> again;
  std::swap(again, batch.Again);
  for (const std::int32_t vertex : again)
  {
    const ShadowLine line = this->LineOf(vertex);
    batch.Clear();
    this->Add(vertex, line, true, batch);
    this->CastLines(*this->Casters[static_cast<std::size_t>(line.Frame)], batch);
  }
  return batch.Sums;
}

}

//------------------------------------------------------------------------------
RayStatistics CastShadows(
  const ShadowScene& scene, const glm::dvec4& light, const RangeLoop& loop, const ShadowTaker& take)
{
  const ShadowCast cast(scene, light, loop, take);
  const std::size_t vertices = scene.Starts->GetVertices().size();
  std::vector<RayStatistics> sums((vertices + BatchSize - 1) / BatchSize);
  loop(sums.size(),
    [&](std::size_t begin, std::size_t end)
    {
      const auto batch = std::make_unique<ShadowBatch>();
      for (std::size_t i = begin; i < end; ++i)
      {
        sums[i] = cast.Cast(i * BatchSize, std::min(vertices, (i + 1) * BatchSize), *batch);
      }
    });
  RayStatistics total;
  for (const RayStatistics& sum : sums)
  {
    total.Steps += sum.Steps;
    total.Rays += sum.Rays;
    total.Lost += sum.Lost;
  }
  return total;
}

}
