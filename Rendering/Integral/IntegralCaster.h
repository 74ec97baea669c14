// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/Native/NativeScene.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Rendering/Integral/EnergyBins.h"
#include "Rendering/Integral/IntegralArrays.h"
#include "Rendering/Integral/IntegralView.h"
#include "Volume/Rays/RayStatistics.h"

#include <cstdint>
#include <functional>
#include <string>

namespace meniscus
{

/** Tables of an input, and the caster that makes images of integrals of them. */
class IntegralCaster : public RayCastTables
{
public:
  /** Called on the calling thread with the fraction done; returns false to abort. */
  using Progress = std::function<bool(double)>;

  /**
   * Measures the rays of a view. The tables must be up to date for the arrays that are wanted.
   * @param cells cells of the input; used for events only, for which Input must know them.
   * @return an error, or an empty text; also after an abort, see WasAborted().
   */
  std::string Measure(const IntegralChoice& choice, const IntegralView& view, const int size[2],
    const InputCells& cells, IntegralArrays& arrays, const Progress& progress);

  /** Notes an image without rays. */
  void ClearStatistics() { this->Statistics = RayStatistics(); }
  bool WasAborted() const { return this->Aborted; }
  /** Statistics of the last image: its rays, and the steps and lost rays of all casts. */
  const RayStatistics& GetStatistics() const { return this->Statistics; }
  /** Number of casts of an image's rays since construction. */
  std::int64_t GetNumberOfCasts() const { return this->Casts; }

  EnergyBinTables Bins;

private:
  /** Processes a tile; the statistics count its rays. */
  using TileBody =
    std::function<RayStatistics(const TileCaster&, int tile, TileCaster::Workspace&)>;

  bool Cast(const TileCaster::Scene& scene, const TileBody& body, const Progress& progress);
  template <typename Set>
  bool CastPixels(const TileCaster::Scene& scene, const Progress& progress, const Set& set);
  bool MeasureScalars(TileCaster::Scene scene, const IntegralChoice& choice, IntegralArrays& arrays,
    const Progress& progress);
  bool MeasureEvents(TileCaster::Scene scene, const EventChoice& choice,
    const EventContext& context, IntegralArrays& arrays, const Progress& progress);
  bool MeasureBins(TileCaster::Scene scene, const EnergyBinTables::Table& table,
    IntegralArrays& arrays, const Progress& progress);

  NativeScene Scenes;
  RayStatistics Statistics;
  std::int64_t Casts = 0;
  /** Casts that the image takes, and those that are done. */
  int PlannedCasts = 1;
  int DoneCasts = 0;
  bool Aborted = false;
};

}
