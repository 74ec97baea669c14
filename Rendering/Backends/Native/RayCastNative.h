// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_Native_RayCastNative_h
#define meniscus_Rendering_Backends_Native_RayCastNative_h

#include "Rendering/Backends/Native/NativeScene.h"
#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Backends/TableCounter.h"
#include "Volume/Caster/TileCaster.h"
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
  std::string Update(const RayCastRequest& request) override;
  std::string Cast(const RayCastRequest& request, RayCastTarget& target) override;
  RayCastStatistics GetStatistics() override;
  bool CountsOverlaps() const override { return true; }
  RayCastCounters GetCounters() override;

private:
  std::int64_t SizeOf(RayCastTable table, const RayCastTables& tables) const;
  /**
   * Casts the image, or the tiles of it in which a depth has changed.
   * @param depths  window depths in [0, 1], one per pixel, rows from below.
   * @param before  depths that the image was cast for, if the frame is the same otherwise, or null.
   */
  void BoundFilled(const TileCaster& caster);
  void CastTiles(const TileCaster::Scene& scene, const std::vector<float>& depths,
    const std::vector<float>* before);

  NativeScene Scene;
  TableCounter Counter;
  /** Image of the last frame, and the statistics of its tiles. */
  std::vector<float> Image;
  int ImageWidth = 0;
  /** Box around the pixels that are not zero. */
  RayCastImageBox Filled{ 0, 0, 0, 0 };
  std::vector<RayStatistics> OfTile;
  std::int64_t CastPixels = 0;
};

/** Makes the backend of one mapper. */
std::unique_ptr<RayCastBackend> MakeNativeBackend(RayCastSharing& sharing);

}

#endif
