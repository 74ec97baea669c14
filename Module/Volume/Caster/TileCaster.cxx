// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/TileCaster.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Kernels/PacketKernels.h"
#include "Volume/Packet/Models/RayEventSegments.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

bool IsOfBins(RayMeasuring measuring)
{
  return measuring == RayMeasuring::VertexBins || measuring == RayMeasuring::CellBins;
}

/** Events of a ray that begins. In modes that show one place, all of them are found together. */
RayEventState FirstState(const TileCaster::Scene& scene)
{
  RayEventState state = EmptyRayEvents();
  const bool areApart = GetBlendModel(scene.Blending).AccumulatesOpacity();
  for (int kind = 0; areApart && kind < NumberOfRayEvents; ++kind)
  {
    if ((scene.WantedEvents >> kind & 1u) == 0)
    {
      IgnoreEvent(static_cast<RayEventKind>(kind), state);
    }
  }
  return state;
}

/** Rays from a tile to the next one: tiles have whole pixels. */
int PitchOf(const TileCaster::Scene& scene)
{
  return TileCaster::PixelsAcrossTile(scene.RaysAcross) * scene.RaysAcross;
}

/** A medium in single precision. */
PacketFading Pack(const RefractionMedium& medium)
{
  const auto toFloat = [](double value) { return static_cast<float>(value); };
  PacketFading fading{};
  fading.IsLinear = medium.Kind == RefractionMedium::Model::Linear;
  std::transform(medium.Attenuation.begin(), medium.Attenuation.end(), fading.Attenuation, toFloat);
  std::transform(medium.Range.begin(), medium.Range.end(), fading.Range, toFloat);
  std::transform(medium.Color.begin(), medium.Color.end(), fading.Color, toFloat);
  return fading;
}

}

struct TileCaster::TileWork
{
  PacketJob Job;
  Workspace& Buffers;
  /** Colour of the tile's first ray, and rays from a row to the next one; null for measurements. */
  float* Image;
  std::int64_t Stride;
  RayStatistics Sums;
};

//------------------------------------------------------------------------------
TileCaster::Workspace::Workspace() = default;
TileCaster::Workspace::Workspace(const Workspace&) = default;
TileCaster::Workspace::~Workspace() = default;

//------------------------------------------------------------------------------
TileCaster::TileCaster(const Scene& scene, const RangeLoop& loop)
  : Input(scene)
  , Legs(scene.Rays.GetFrame(), scene.Rays.GetWidth(), scene.Rays.GetHeight(), scene.Refracted.Legs,
      PitchOf(scene))
  , Sight(this->Input.Rays, scene.Tables->Vertices, *scene.Boundary, scene.Refracted.Tree,
      this->Input.ClippingPlanes, this->Legs, this->SightOptics(), scene.Set, loop, PitchOf(scene),
      scene.Refining)
{
  if (scene.PreIntegration)
  {
    const PreIntegrationTable& table = *scene.PreIntegration;
    this->SegmentTable = { table.GetValues().data(), table.GetNumberOfScalars(),
      table.GetNumberOfLengths(), static_cast<float>(1.0 / table.GetShortest()),
      static_cast<float>(table.GetLengthsPerOctave()), static_cast<float>(table.GetMiddle()),
      static_cast<float>(table.GetPerHalfRange()) };
  }
  if (scene.Medium)
  {
    this->Fading = Pack(*scene.Medium);
  }
  if (this->Legs.GetNumberOfLegs() > 1)
  {
    this->Refracted = std::make_unique<RefractedLegEntries>(this->Input.Refracted, *scene.Mesh,
      this->Input.Rays, this->Input.ClippingPlanes, this->Legs, this->SightOptics(), scene.Set);
  }
}

//------------------------------------------------------------------------------
/** Optics in the frame of the view. */
FrameOptics TileCaster::SightOptics() const
{
  return { this->Input.Lighting, this->Input.GradientToFrame, this->Input.GradientMagnitude,
    this->Input.GradientOpacity ? &this->Input.Tables->GradientIntervals : nullptr };
}

//------------------------------------------------------------------------------
void TileCaster::SetOptics(const Scene& scene, PacketJob& job)
{
  const PacketTables& tables = *scene.Tables;
  const auto sizeOf = [](const auto& table) { return static_cast<std::int32_t>(table.size()); };
  const TetrahedralMesh& mesh = *scene.Mesh;
  job.Blending = scene.Blending;
  job.Emitting = scene.Emitting;
  job.Cells = mesh.GetCells().front().Vertices.data();
  job.NumberOfCells = mesh.GetNumberOfCells();
  static_assert(sizeof(CellPassages) == 8 * sizeof(std::int32_t), "eight numbers");
  job.Passages = &scene.Passages->front().Of.front().Link;
  job.CellScalars = scene.CellScalars;
  job.Surfaces = tables.Surfaces.data();
  job.NumberOfSurfaces = sizeOf(tables.Surfaces);
  job.VertexGradients = scene.VertexGradients ? &scene.VertexGradients->x : nullptr;
  job.CellGradients = scene.CellGradients ? &scene.CellGradients->x : nullptr;
  job.Intervals = tables.Intervals.data();
  job.NumberOfIntervals = sizeOf(tables.Intervals);
  job.TerminationTransmittance = scene.TerminationTransmittance;
  const ScalarRange& range = scene.DataRange;
  job.SharePerScalar = static_cast<float>(1.0 / (range.Highest - range.Lowest));
  job.ShareAtZero = static_cast<float>(-range.Lowest / (range.Highest - range.Lowest));
  job.Mixture = scene.Mixture;
  job.Components = scene.Components ? &scene.Components->x : nullptr;
  for (std::size_t i = 0; i < tables.OtherIntervals.size(); ++i)
  {
    job.OtherIntervals[i] = tables.OtherIntervals[i].data();
    job.NumberOfOtherIntervals[i] = sizeOf(tables.OtherIntervals[i]);
  }
}

//------------------------------------------------------------------------------
void TileCaster::CastBatch(const LegBatch& batch, PacketJob& job, Workspace& workspace) const
{
  workspace.Results.resize(batch.Rays.size());
  job.Rays = batch.Rays.data();
  job.NumberOfRays = static_cast<std::int32_t>(batch.Rays.size());
  job.Entries = batch.Entries;
  job.Results = workspace.Results.data();
  if (job.Measuring == RayMeasuring::Events)
  {
    workspace.EventStates.clear();
    for (const LegBatch::Origin& origin : batch.Origins)
    {
      const auto pixel = static_cast<std::size_t>(origin.Pixel);
      workspace.EventStates.push_back(workspace.Measured.Events[pixel].State);
    }
    job.Events = workspace.EventStates.data();
    job.EventLimits.LargestAttenuation = BoundAttenuation(job);
  }
  else if (job.Measuring != RayMeasuring::None)
  {
    workspace.Values.resize(NumberOfMeasuredScalars * batch.Rays.size());
    job.Values = workspace.Values.data();
  }
  CastPackets(job, this->Input.Set);
}

//------------------------------------------------------------------------------
/** Writes the results of rays of one leg, which are colours, to the image. */
void TileCaster::Show(
  const LegBatch& batch, const std::vector<PacketResult>& results, TileWork& work)
{
  RayStatistics& sums = work.Sums;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    const PacketResult& result = results[i];
    sums.Lost += result.Lost;
    sums.Overlaps += result.Overlaps;
    if (result.Steps == 0)
    {
      continue;
    }
    sums.Steps += result.Steps;
    ++sums.Rays;
    const std::int32_t pixel = batch.Origins[i].Pixel;
    const std::int64_t row = pixel / RefractedRayTiles::TileSize;
    const std::int64_t column = pixel % RefractedRayTiles::TileSize;
    std::copy_n(result.Color, 4, work.Image + 4 * (row * work.Stride + column));
  }
}

//------------------------------------------------------------------------------
/** Joins the measurement of a ray of a batch to the measurements of the legs in front of it. */
template <class Entries>
void TileCaster::JoinMeasured(const Entries& entries, int frame, const TileLeg& leg,
  const LegBatch& batch, std::size_t ray, Workspace& workspace) const
{
  const std::int32_t pixel = batch.Origins[ray].Pixel;
  const auto at = static_cast<std::size_t>(pixel);
  if (IsOfBins(this->Input.Measuring))
  {
    workspace.Measured.Bins[at].Join(ReadBins(workspace.Results[ray].Color));
    return;
  }
  const double from = this->Input.MeasuredFrom;
  RayLeg line;
  this->Legs.Find(leg.Tile, pixel, leg.Number, line);
  LegDistance distance;
  distance.AtBegin = this->Legs.GetLengthBefore(leg.Tile, pixel, leg.Number, from);
  distance.BeginDepth = entries.GetBeginDepth(frame, line, from);
  distance.PerDepth = batch.Rays[ray].LengthPerDepth;
  if (this->Input.Measuring == RayMeasuring::Events)
  {
    const glm::dmat3& toWorld = this->Legs.GetSight().ViewToWorld;
    const double perStep = glm::length(toWorld * line.Step);
    // In double precision, since a place far from the camera is a small part of the distance.
    distance.PerDepth = perStep * entries.GetStepsPerDepth(frame, line);
    const double drawn = leg.Number == 0 ? from : line.Depth;
    const glm::dvec3 begin = leg.Number == 0 ? line.Begin + from * line.Step : line.Begin;
    TakeEvents(workspace.EventStates[ray],
      { distance, begin, line.Step / perStep, drawn, 1.0 / perStep },
      workspace.Measured.Events[at]);
    return;
  }
  workspace.Measured.Scalars[at].Join(
    ReadScalars(workspace.Values.data() + NumberOfMeasuredScalars * ray, distance));
}

//------------------------------------------------------------------------------
/** Computes the way through the medium behind the first interface to the rays of a batch. */
template <class Entries>
void TileCaster::FindPaths(const Entries& entries, int frame, const TileLeg& leg,
  const LegBatch& batch, Workspace& workspace) const
{
  workspace.Paths.resize(batch.Rays.size());
  for (std::size_t i = 0; i < batch.Rays.size(); ++i)
  {
    const std::int32_t pixel = batch.Origins[i].Pixel;
    RayLeg line;
    this->Legs.Find(leg.Tile, pixel, leg.Number, line);
    workspace.Paths[i] =
      static_cast<float>(this->Legs.GetLengthBehindMembrane(leg.Tile, pixel, leg.Number) -
        entries.GetBeginDepth(frame, line, 0.0) * batch.Rays[i].LengthPerDepth);
  }
}

//------------------------------------------------------------------------------
/** Casts one leg, frame by frame, and joins the results, or shows them if there is no other leg. */
template <class Entries>
void TileCaster::CastLeg(const Entries& entries, typename Entries::Workspace& found,
  const TileLeg& leg, TileWork& work) const
{
  PacketJob& job = work.Job;
  Workspace& workspace = work.Buffers;
  entries.Collect(leg, job, workspace.Joined, found);
  job.Fading = this->Input.Medium && leg.Number > 0 ? &this->Fading : nullptr;
  for (int frame = 0; frame < Entries::NumberOfFrames; ++frame)
  {
    entries.GetFrame(frame).Describe(job);
    while (const LegBatch* batch = entries.NextBatch(frame, found))
    {
      if (job.Fading)
      {
        this->FindPaths(entries, frame, leg, *batch, workspace);
        job.PathsAtPivot = workspace.Paths.data();
      }
      this->CastBatch(*batch, job, workspace);
      if (!job.KeepsValues)
      {
        Show(*batch, workspace.Results, work);
        continue;
      }
      for (std::size_t i = 0; i < workspace.Results.size(); ++i)
      {
        const PacketResult& result = workspace.Results[i];
        const bool again = result.Lost != 0 && entries.TakeBack(frame, i, found);
        workspace.Joined.AddSteps(batch->Origins[i].Pixel, result.Steps);
        if (again)
        {
          continue;
        }
        if (job.Measuring != RayMeasuring::None)
        {
          this->JoinMeasured(entries, frame, leg, *batch, i, workspace);
        }
        else
        {
          workspace.Joined.Join(batch->Origins[i], job.Blending, result);
        }
        workspace.Joined.EndAt(batch->Origins[i], result);
        work.Sums.Lost += result.Lost;
        work.Sums.Overlaps += result.Overlaps;
      }
    }
  }
}

//------------------------------------------------------------------------------
TileLeg TileCaster::FirstLeg(int tile, const float* opaqueDepth) const
{
  TileLeg leg{ tile, 0, this->GetBox(tile), opaqueDepth };
  leg.RaysAcross = this->Input.RaysAcross;
  return leg;
}

//------------------------------------------------------------------------------
/** Casts the first leg and all further ones of a tile. */
void TileCaster::CastLegs(TileLeg leg, TileWork& work) const
{
  const int legs = std::min(this->Legs.GetNumberOfLegs(leg.Tile), this->Input.Refracted.Drawn.End);
  for (; leg.Number < legs; ++leg.Number)
  {
    this->CastOneLeg(leg, work);
  }
}

//------------------------------------------------------------------------------
/** Casts a leg, or passes it if it is in front of those that are drawn. */
void TileCaster::CastOneLeg(const TileLeg& leg, TileWork& work) const
{
  if (leg.Number < this->Input.Refracted.Drawn.First)
  {
    work.Buffers.Joined.SkipLeg();
  }
  else if (leg.Number == 0)
  {
    this->CastLeg(this->Sight, work.Buffers.Sight, leg, work);
  }
  else
  {
    this->CastLeg(*this->Refracted, work.Buffers.Refracted, leg, work);
  }
}

//------------------------------------------------------------------------------
/** First leg, from `leg` on, of a tile's rays that may meet the mesh; their number if none does. */
int TileCaster::FindShowingLeg(int tile, int leg) const
{
  const int legs = this->Legs.GetNumberOfLegs(tile);
  while (leg < legs && !(leg == 0 ? this->Sight.MayShow(tile) : this->Legs.MayShow(leg, tile)))
  {
    ++leg;
  }
  return leg;
}

//------------------------------------------------------------------------------
/** True if several legs of a tile's rays may meet the mesh, or if a medium fades one of them. */
bool TileCaster::JoinsLegs(int tile) const
{
  const int legs = this->Legs.GetNumberOfLegs(tile);
  const int first = this->FindShowingLeg(tile, 0);
  return legs > 1 && (this->Input.Medium || this->FindShowingLeg(tile, first + 1) < legs);
}

//------------------------------------------------------------------------------
RayStatistics TileCaster::Cast(
  int tile, const float* opaqueDepth, float* image, Workspace& workspace) const
{
  const int legs = this->Legs.GetNumberOfLegs(tile);
  const BoundaryRaster::PixelBox box = this->GetBox(tile);
  const std::int64_t stride = this->Legs.GetWidth();
  TileWork work{ PacketJob{}, workspace, image + 4 * (box.Bottom * stride + box.Left), stride,
    RayStatistics() };
  if (legs <= this->Input.Refracted.Drawn.First)
  {
    return work.Sums;
  }
  this->SetPictureOptics(work.Job);
  work.Job.KeepsValues = this->JoinsLegs(tile);
  if (legs > 1)
  {
    workspace.Joined.Clear(work.Job.Blending);
  }
  if (this->Input.Interpolating && this->Interpolates(work.Job))
  {
    this->CastSome(this->FirstLeg(tile, opaqueDepth), image, work);
    return work.Sums;
  }
  this->CastLegs(this->FirstLeg(tile, opaqueDepth), work);
  if (work.Job.KeepsValues)
  {
    workspace.Joined.Finish(work.Job, box, this->Legs.GetWidth(), image, work.Sums);
  }
  return work.Sums;
}

//------------------------------------------------------------------------------
/**
 * True if rays may be interpolated. Isosurfaces end at outlines, most of which would be found, but
 * not small pieces; and most of their rays would have to be cast. Legs that are joined are cast one
 * after the other, so that the colours of rays are known too late.
 */
bool TileCaster::Interpolates(const PacketJob& job) const
{
  return !job.KeepsValues && GetBlendModel(this->Input.Blending).Subject != BlendSubject::Surfaces;
}

//------------------------------------------------------------------------------
/**
 * Lists the lines of a leg of all rays of a tile, and the numbers of their entries. Rays that end
 * at the next interface have other numbers than those that pass it.
 */
void TileCaster::ListEntries(const TileLeg& leg, TileWork& work) const
{
  Workspace& workspace = work.Buffers;
  InterpolatedRays::NumbersOfEntries& numbers = workspace.NumbersOfEntries;
  if (leg.Number == 0)
  {
    this->GetRaster().CollectEntries(leg.Tile, workspace.Sight.Raster);
    const EntryLists& lists = workspace.Sight.Raster.Lists;
    for (std::size_t ray = 0; ray < numbers.size(); ++ray)
    {
      numbers[ray] = lists.GetBegin(ray + 1) - lists.GetBegin(ray);
    }
  }
  else
  {
    numbers.fill(0);
    this->Refracted->Collect(leg, work.Job, workspace.Joined, workspace.Refracted);
    this->Refracted->CountEntries(workspace.Refracted, numbers);
  }
  const RefractedRay* next = leg.Number + 1 < this->Legs.GetNumberOfLegs()
    ? this->Legs.GetTile(leg.Number + 1, leg.Tile)
    : nullptr;
  for (std::size_t ray = 0; next && ray < numbers.size(); ++ray)
  {
    constexpr std::int32_t ending = 1 << 16;
    numbers[ray] += numbers[ray] > 0 && next[ray].MeetsInterface() ? ending : 0;
  }
}

//------------------------------------------------------------------------------
/**
 * Casts rays of a tile of which one leg at most may meet the mesh, and interpolates the others.
 * @param leg their first leg.
 */
void TileCaster::CastSome(TileLeg leg, float* image, TileWork& work) const
{
  const LegRange& drawn = this->Input.Refracted.Drawn;
  const int showing = this->FindShowingLeg(leg.Tile, 0);
  if (showing < drawn.First || showing >= std::min(this->Legs.GetNumberOfLegs(leg.Tile), drawn.End))
  {
    return;
  }
  for (; leg.Number < showing; ++leg.Number)
  {
    this->CastOneLeg(leg, work); // nothing but the places where the next leg begins
  }
  this->ListEntries(leg, work);
  InterpolatedRays& rays = work.Buffers.Interpolated;
  rays.Begin(
    { leg.Box, &work.Buffers.NumbersOfEntries, showing == 0 ? &this->Legs.GetSight() : nullptr,
      leg.OpaqueDepth, image, this->Legs.GetWidth() });
  leg.Selected = &rays.GetSelected();
  leg.IsListed = true;
  do
  {
    this->CastOneLeg(leg, work);
  } while (rays.SelectMore());
  const std::int64_t interpolated = rays.GetNumberOfInterpolated();
  work.Sums.Interpolated += interpolated;
  work.Sums.Rays += interpolated;
}

//------------------------------------------------------------------------------
/** Sets the optics that pictures have, but measurements do not need. */
void TileCaster::SetPictureOptics(PacketJob& job) const
{
  SetOptics(this->Input, job);
  job.SegmentTable = this->Input.PreIntegration ? &this->SegmentTable : nullptr;
  job.VertexLight = this->Input.VertexLight ? &this->Input.VertexLight->x : nullptr;
}

//------------------------------------------------------------------------------
BoundaryRaster::PixelBox TileCaster::GetPixels(int tile) const
{
  const BoundaryRaster::PixelBox rays = this->GetBox(tile);
  const int across = this->Input.RaysAcross;
  return { rays.Left / across, rays.Right / across, rays.Bottom / across, rays.Top / across };
}

//------------------------------------------------------------------------------
RayStatistics TileCaster::Refine(int tile, const float* opaqueDepth, const EdgesOfImage& edges,
  float* image, Workspace& workspace) const
{
  PixelRays& rays = workspace.Refining;
  const std::int64_t width = this->Legs.GetWidth() / this->Input.RaysAcross;
  rays.Begin(this->GetBox(tile), this->Input.RaysAcross, edges.Codes, width, edges.Tolerated);
  TileWork work{ PacketJob{}, workspace, rays.GetColors(), PixelRays::TileSize, RayStatistics() };
  this->SetPictureOptics(work.Job);
  TileLeg leg = this->FirstLeg(tile, opaqueDepth);
  leg.Selected = &rays.GetSelected();
  do
  {
    this->CastLegs(leg, work);
  } while (rays.SelectMore(image));
  rays.Finish(image);
  return work.Sums;
}

//------------------------------------------------------------------------------
RayStatistics TileCaster::Measure(int tile, Workspace& workspace, const float* opaqueDepth) const
{
  TileWork work{ PacketJob{}, workspace, nullptr, 0, RayStatistics() };
  SetOptics(this->Input, work.Job);
  work.Job.Measuring = this->Input.Measuring;
  work.Job.KeepsValues = true;
  // It hides nothing.
  workspace.Joined.Clear(BlendMode::AverageIntensity);
  if (IsOfBins(this->Input.Measuring))
  {
    workspace.Measured.Bins.fill(MeasuredBin());
  }
  else if (this->Input.Measuring == RayMeasuring::Events)
  {
    work.Job.EventLimits.Opacity = this->Input.EventOpacity;
    work.Job.EventLimits.OpticalDepth = -std::log1p(-this->Input.EventOpacity);
    workspace.Measured.Events.assign(
      RefractedRayTiles::RaysOfTile, { FirstState(this->Input), {} });
  }
  else
  {
    workspace.Measured.Scalars.fill(MeasuredScalar());
  }
  this->CastLegs(this->FirstLeg(tile, opaqueDepth), work);
  for (std::int32_t pixel = 0; pixel < RefractedRayTiles::RaysOfTile; ++pixel)
  {
    const std::int32_t steps = workspace.Joined.GetSteps(pixel);
    work.Sums.Steps += steps;
    work.Sums.Rays += steps > 0;
  }
  return work.Sums;
}

}
