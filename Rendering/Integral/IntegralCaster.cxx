// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/IntegralCaster.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Integral/TilePixels.h"

#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <vector>

namespace meniscus
{
namespace
{

/**
 * Tiles between two reports of progress, for each thread: at most about 1 ms of work each, and
 * enough of them that the threads rarely wait for each other at the end.
 */
constexpr int TilesPerThread = 16;

RayCastFrame FrameOf(const RayCastTables& tables, const IntegralView& view)
{
  RayCastFrame frame;
  frame.Rays = view.Rays;
  frame.Optics.CellScalars = tables.Input.GetFieldAssociation() == FieldAssociation::Cells;
  frame.Optics.DataRange = tables.Input.GetNormalizedRange();
  return frame;
}

}

//------------------------------------------------------------------------------
/** Processes the tiles of a scene on all threads. Returns false after an abort. */
bool IntegralCaster::Cast(
  const TileCaster::Scene& scene, const TileBody& body, const Progress& progress)
{
  const TileCaster caster(scene, ThreadedLoop);
  const int tiles = caster.GetNumberOfTiles();
  std::vector<RayStatistics> ofTile(static_cast<std::size_t>(tiles));
  vtkSMPThreadLocal<TileCaster::Workspace> workspaces;
  const int step = TilesPerThread * std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  for (int first = 0; first < tiles && !this->Aborted; first += step)
  {
    const int last = std::min(tiles, first + step);
    ThreadedFor(first, last, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        TileCaster::Workspace& workspace = workspaces.Local();
        for (auto tile = static_cast<int>(begin); tile < end; ++tile)
        {
          ofTile[static_cast<std::size_t>(tile)] = body(caster, tile, workspace);
        }
      });
    const double done = static_cast<double>(last) / tiles;
    this->Aborted = !progress((this->DoneCasts + done) / this->PlannedCasts);
  }
  const RayStatistics sums = SumOf(ofTile);
  this->Statistics.Rays = sums.Rays;
  this->Statistics.Steps += sums.Steps;
  this->Statistics.Lost += sums.Lost;
  this->Statistics.Overlaps = sums.Overlaps;
  ++this->Casts;
  ++this->DoneCasts;
  return !this->Aborted;
}

//------------------------------------------------------------------------------
/** As Cast(), with a call `set(pixel, its number in the tile, measured rays)` for each pixel. */
template <typename Set>
bool IntegralCaster::CastPixels(
  const TileCaster::Scene& scene, const Progress& progress, const Set& set)
{
  return this->Cast(
    scene,
    [&set](const TileCaster& caster, int tile, TileCaster::Workspace& workspace)
    {
      const RayStatistics sums = caster.Measure(tile, workspace);
      ForEachPixel(caster, tile,
        [&](std::int64_t pixel, std::size_t inTile) { set(pixel, inTile, workspace.Measured); });
      return sums;
    },
    progress);
}

//------------------------------------------------------------------------------
bool IntegralCaster::MeasureScalars(TileCaster::Scene scene, const IntegralChoice& choice,
  IntegralArrays& arrays, const Progress& progress)
{
  scene.Measuring = choice.Has(IntegralArray::OpticalDepth) ? RayMeasuring::ScalarsAndOpticalDepth
                                                            : RayMeasuring::Scalars;
  const ScalarNormalization& normalization = this->Input.GetNormalization();
  return this->CastPixels(scene, progress,
    [&](std::int64_t pixel, std::size_t inTile, const auto& measured)
    { arrays.SetScalar(pixel, measured.Scalars[inTile], normalization); });
}

//------------------------------------------------------------------------------
bool IntegralCaster::MeasureEvents(TileCaster::Scene scene, const EventChoice& choice,
  const EventContext& context, IntegralArrays& arrays, const Progress& progress)
{
  scene.Measuring = RayMeasuring::Events;
  scene.Blending = choice.Blending;
  scene.EventOpacity = choice.Opacity;
  scene.WantedEvents = 0;
  for (std::size_t kind = 0; kind < choice.Wanted.size(); ++kind)
  {
    scene.WantedEvents |= static_cast<std::uint32_t>(choice.Wanted[kind]) << kind;
  }
  return this->CastPixels(scene, progress,
    [&](std::int64_t pixel, std::size_t inTile, const auto& measured)
    { arrays.Events.Set(pixel, measured.Events[inTile], context); });
}

//------------------------------------------------------------------------------
bool IntegralCaster::MeasureBins(TileCaster::Scene scene, const EnergyBinTables::Table& table,
  IntegralArrays& arrays, const Progress& progress)
{
  const bool ofCells = this->Bins.GetFieldAssociation() == FieldAssociation::Cells;
  scene.Measuring = ofCells ? RayMeasuring::CellBins : RayMeasuring::VertexBins;
  scene.Emitting = this->Bins.IsEmitting();
  scene.CellScalars = nullptr;
  (ofCells ? scene.CellGradients : scene.Components) = table.Values.data();
  return this->CastPixels(scene, progress,
    [&](std::int64_t pixel, std::size_t inTile, const auto& measured)
    { arrays.SetBins(pixel, measured.Bins[inTile], table, scene.Emitting); });
}

//------------------------------------------------------------------------------
std::string IntegralCaster::Measure(const IntegralChoice& choice, const IntegralView& view,
  const int size[2], const InputCells& cells, IntegralArrays& arrays, const Progress& progress)
{
  this->Statistics = RayStatistics();
  this->Aborted = false;
  RayCastFrame frame = FrameOf(*this, view);
  if (this->Membrane.GetNumberOfInterfaces() > 0)
  {
    RefractedRayStack::View sight;
    sight.Frame = view.Rays;
    sight.Width = size[0];
    sight.Height = size[1];
    sight.Center = view.Center;
    sight.EyeDepth = view.BeginDepth;
    frame.Refracting.Met = this->Membrane.Trace(sight, this->Input);
    const std::string mismatch = this->Membrane.DescribeMismatch();
    if (!mismatch.empty())
    {
      return mismatch;
    }
  }
  this->Scenes.UpdateProperty(this->Property);
  TileCaster::Scene scene = this->Scenes.Make(*this, frame, size[0], size[1]);
  scene.MeasuredFrom = view.MeasuredFrom;
  this->DoneCasts = 0;
  this->PlannedCasts = static_cast<int>(choice.NeedsScalars()) +
    static_cast<int>(choice.Has(IntegralArray::RGBA)) +
    static_cast<int>(choice.Events.IsAnyWanted()) +
    (choice.NeedsBinArrays() ? static_cast<int>(this->Bins.GetTables().size()) : 0);
  if (choice.NeedsScalars() && !this->MeasureScalars(scene, choice, arrays, progress))
  {
    return std::string();
  }
  for (std::size_t i = 0; choice.NeedsBinArrays() && i < this->Bins.GetTables().size(); ++i)
  {
    if (!this->MeasureBins(scene, this->Bins.GetTables()[i], arrays, progress))
    {
      return std::string();
    }
  }
  if (choice.Events.IsAnyWanted())
  {
    const EventContext context{ cells, this->Input.GetInputCells(), this->Input.GetNormalization(),
      IndicesOf(this->Property.GetIsosurfaces()), view.Center, view.Rays.ViewToWorld };
    if (!this->MeasureEvents(scene, choice.Events, context, arrays, progress))
    {
      return std::string();
    }
  }
  if (choice.Has(IntegralArray::RGBA))
  {
    float* image = arrays.GetImage();
    this->Cast(
      scene,
      [image](const TileCaster& caster, int tile, TileCaster::Workspace& workspace)
      { return caster.Cast(tile, nullptr, image, workspace); },
      progress);
  }
  return std::string();
}

}
