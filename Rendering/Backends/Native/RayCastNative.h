// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/Native/ImageDepths.h"
#include "Rendering/Backends/Native/NativeScene.h"
#include "Rendering/Backends/Native/RefinedImage.h"
#include "Rendering/Backends/Native/TilesToCast.h"
#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Backends/TableCounter.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Rays/RayStatistics.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

/**
 * Ray caster on the CPU: SIMD packets of the widest instruction set there is, tiles in parallel by
 * vtkSMPTools. The image does not depend on the number of threads. Draws every frame; reads the
 * mapper's tables where they are and counts their bytes once per version.
 */
class RayCastNative : public RayCastBackend
{
public:
  std::string CanDraw(const RayCastRequest&) override { return std::string(); }
  bool IsRepeatable() const override { return true; }
  bool CastsSeveralRays(const RayCastRequest& request) const override;
  std::string Update(const RayCastRequest& request) override;
  std::string Cast(const RayCastRequest& request, RayCastTarget& target) override;
  RayCastStatistics GetStatistics() override;
  bool CountsOverlaps() const override { return true; }
  RayCastCounters GetCounters() override;

private:
  std::int64_t SizeOf(RayCastTable table, const RayCastTables& tables) const;
  void BoundFilled(const TileCaster& caster);
  bool CastTiles(const TileCaster& caster, const ImageDepths& depths, RayCastTarget& target);

  NativeScene Scene;
  TableCounter Counter;
  /** Image of the last frame, with one ray per pixel, and the statistics of its tiles. */
  std::vector<float> Image;
  int ImageWidth = 0;
  /** Box around the pixels that are not zero. */
  BoundaryRaster::PixelBox Filled{ 0, 0, 0, 0 };
  std::vector<RayStatistics> OfTile;
  TilesToCast Tiles;
  /** The same image with several rays for pixels at edges; empty unless these are wanted. */
  RefinedImage Refined;
  std::int64_t CastPixels = 0;
};

/** Makes the backend of one mapper. */
std::unique_ptr<RayCastBackend> MakeNativeBackend(RayCastSharing& sharing);

}
