// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/VertexShadows.h"

#include "Volume/Caster/LegFrame.h"
#include "Volume/Entries/EntryLists.h"
#include "Volume/Illumination/EntryHorizon.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Kernels/PacketKernels.h"
#include "Volume/Refracted/RayBundleEntries.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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
  /** Depths of the start, and of the part that is cast. */
  double Place = 0.0;
  double Begin = 0.0;
  double End = 0.0;
};

/** Lines of one frame that are being cast, with buffers. */
struct ShadowBatch
{
  /** The lines of a range of the starts. */
  std::array<ShadowLine, BatchSize> Lines;
  /** Lines that may enter by faces of the boundary, the first `Searched` ones of a cast. */
  std::array<LineBlock, BatchSize / LineBlock::Size> Blocks;
  std::size_t Searched = 0;
  /** Rays of all lines, their starts and their numbers in Entries. */
  std::vector<PacketRay> Rays;
  std::vector<std::int32_t> Starts;
  std::vector<std::int32_t> Numbers;
  /** Entries in the cells of the starts, and the numbers of the lines that have one. */
  std::vector<std::pair<std::int32_t, PacketEntry>> Inside;
  RayBundleEntries::Workspace Found;
  EntryLists Entries;
  std::vector<PacketResult> Results;
  /** Starts whose lines are cast again, from the boundary. */
  std::vector<std::int32_t> Again;
  RayStatistics Sums;

  void Clear()
  {
    this->Searched = 0;
    this->Rays.clear();
    this->Starts.clear();
    this->Numbers.clear();
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
  FrameCaster(const ShadowScene& scene, const RefractionFrame& frame, bool isParallel)
    : Frame(frame)
    , Entries(*scene.Medium.Mesh, *scene.Tree, frame, scene.Medium.Set)
  {
    const TileCaster::Scene& medium = scene.Medium;
    this->Leg.Set(frame.Rays, frame.Vertices,
      { nullptr, frame.FromView * medium.GradientToFrame, medium.GradientMagnitude,
        medium.GradientOpacity ? &medium.Tables->GradientIntervals : nullptr });
    this->IsParallel = isParallel;
    if (isParallel && scene.Starts->AreInside())
    {
      this->Horizon.Set(scene.Tree->GetFaces(), frame);
    }
  }

  /** False if a line that begins in a cell enters the mesh no more. */
  bool MayEnter(const PacketRay& ray, double depth) const
  {
    return !this->IsParallel || this->Horizon.MayEnter(ray, depth);
  }

  const RefractionFrame& Frame;
  RayBundleEntries Entries;
  LegFrame Leg;
  bool IsParallel;
  EntryHorizon Horizon;
};

class ShadowCast
{
public:
  ShadowCast(const ShadowScene& scene, const glm::dvec4& light, const RangeLoop& loop,
    const ShadowTaker& take);

  /** Casts the lines of the starts [first, last). */
  RayStatistics Cast(std::size_t first, std::size_t last, ShadowBatch& batch) const;

private:
  ShadowLine LineOf(std::int32_t start) const;
  void Add(std::int32_t start, const ShadowLine& line, bool fromBoundary, ShadowBatch& batch) const;
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
        ? std::make_unique<FrameCaster>(scene, this->Frames.Get(index), this->Frames.IsParallel())
        : nullptr);
  }
}

//------------------------------------------------------------------------------
ShadowLine ShadowCast::LineOf(std::int32_t start) const
{
  ShadowLine line;
  const glm::dvec3 place = this->Frames.ToBaseFrame(this->Scene.Starts->GetPlace(start));
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
  // A light at the start has no direction, and no way to it.
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
/** Adds a line to the batch, with its entry into the cell of its start. */
void ShadowCast::Add(
  std::int32_t start, const ShadowLine& line, bool fromBoundary, ShadowBatch& batch) const
{
  const FrameCaster& caster = *this->Casters[static_cast<std::size_t>(line.Frame)];
  const FixedPointRays& rays = caster.Frame.Rays;
  PacketRay ray = rays.RayAlong(line.Line.Origin, line.Line.Slope);
  ray.StartDepth = rays.FromPivot(line.Begin);
  ray.EndDepth = rays.FromPivot(line.End);
  PacketEntry entry;
  const bool isInside = !fromBoundary && this->Scene.Starts->AreInside() &&
    caster.Entries.EntersCell(this->Scene.Starts->GetCell(start), ray, line.Place, entry);
  std::size_t number = BatchSize + batch.Rays.size();
  if (!isInside || caster.MayEnter(ray, line.Place))
  {
    number = batch.Searched++;
    LineBlock& block = batch.Blocks[number / LineBlock::Size];
    const int i = block.Count++;
    block.SetRay(i, ray);
    for (int axis = 0; axis < 2; ++axis)
    {
      block.Origin[axis][i] = line.Line.Origin[axis];
      block.Slope[axis][i] = line.Line.Slope[axis];
    }
    block.From[i] = isInside ? line.Place : -caster.Frame.Extent;
  }
  if (isInside)
  {
    batch.Inside.emplace_back(static_cast<std::int32_t>(number), entry);
  }
  batch.Rays.push_back(ray);
  batch.Starts.push_back(start);
  batch.Numbers.push_back(static_cast<std::int32_t>(number));
}

//------------------------------------------------------------------------------
/** Finds the entries of the batch's lines, and drops the lines that meet nothing. */
void ShadowCast::FindRays(const FrameCaster& caster, ShadowBatch& batch) const
{
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t line = 0; line < batch.Searched; ++line)
  {
    const float end = batch.Blocks[line / LineBlock::Size].EndDepth[line % LineBlock::Size];
    last = std::max(last, caster.Frame.Rays.ToFrame(end));
  }
  const std::size_t blocks = (batch.Searched + LineBlock::Size - 1) / LineBlock::Size;
  batch.Found.Clear();
  if (blocks > 0)
  {
    caster.Entries.Collect(batch.Blocks.data(), blocks, batch.Found, last);
  }
  for (const auto& inside : batch.Inside)
  {
    batch.Found.Add(inside.first, inside.second);
  }
  batch.Entries.Set(
    2 * BatchSize, batch.Found.Hits.data(), batch.Found.NumberOfHits, batch.Found.Faces.data());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < batch.Rays.size(); ++i)
  {
    const auto number = static_cast<std::size_t>(batch.Numbers[i]);
    PacketRay& ray = batch.Rays[i];
    ray.FirstEntry = batch.Entries.GetBegin(number);
    ray.EndEntry = batch.Entries.GetBegin(number + 1);
    if (ray.FirstEntry == ray.EndEntry)
    {
      this->Take(batch.Starts[i], 1.0f);
      continue;
    }
    batch.Rays[kept] = ray;
    batch.Starts[kept++] = batch.Starts[i];
  }
  batch.Rays.resize(kept);
  batch.Starts.resize(kept);
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
  const bool isPlain =
    GetBlendModel(job.Blending).IsMedium() && job.Mixture == ComponentMixture::None && !job.Medium;
  job.Measuring = isPlain ? RayMeasuring::OpticalDepth : RayMeasuring::None;
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
      batch.Again.push_back(batch.Starts[i]);
      continue;
    }
    batch.Sums.Lost += result.Lost;
    this->Take(batch.Starts[i], isPlain ? std::exp(-result.Color[0]) : result.Color[3]);
  }
}

//------------------------------------------------------------------------------
RayStatistics ShadowCast::Cast(std::size_t first, std::size_t last, ShadowBatch& batch) const
{
  const std::vector<std::int32_t>& numbers = this->Scene.Starts->GetNumbers();
  const auto* const cells = this->Scene.Medium.Mesh->GetCells().data();
  batch.Sums = RayStatistics();
  for (std::size_t i = first; i < last; ++i)
  {
    ShadowLine& line = batch.Lines[i - first];
    // Read by Add(): these cells are far apart in memory, so that each of them would be waited for.
    __builtin_prefetch(cells + this->Scene.Starts->GetCell(numbers[i]));
    line = this->LineOf(numbers[i]);
    if (line.Frame < 0)
    {
      this->Take(numbers[i], 1.0f);
    }
  }
  for (int frame = 0; frame < this->Frames.GetNumberOfFrames(); ++frame)
  {
    if (!this->Casters[static_cast<std::size_t>(frame)])
    {
      continue;
    }
    batch.Clear();
    for (std::size_t i = first; i < last; ++i)
    {
      if (batch.Lines[i - first].Frame == frame)
      {
        this->Add(numbers[i], batch.Lines[i - first], false, batch);
      }
    }
    if (!batch.Rays.empty())
    {
      this->CastLines(*this->Casters[static_cast<std::size_t>(frame)], batch);
    }
  }
  // Lines that cells inverted by rounding led around.
  std::vector<std::int32_t> again;
  std::swap(again, batch.Again);
  for (const std::int32_t start : again)
  {
    const ShadowLine line = this->LineOf(start);
    batch.Clear();
    this->Add(start, line, true, batch);
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
  const std::size_t starts = scene.Starts->GetNumbers().size();
  std::vector<RayStatistics> sums((starts + BatchSize - 1) / BatchSize);
  loop(sums.size(),
    [&](std::size_t begin, std::size_t end)
    {
      const auto batch = std::make_unique<ShadowBatch>();
      for (std::size_t i = begin; i < end; ++i)
      {
        sums[i] = cast.Cast(i * BatchSize, std::min(starts, (i + 1) * BatchSize), *batch);
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
