// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_Native_RayCastNative_h
#define meniscus_Rendering_Backends_Native_RayCastNative_h

#include "Common/TableVersion.h"
#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Backends/TableCounter.h"
#include "Simd/InstructionSets.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Rays/RayStatistics.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

class VolumePropertyTables;

/**
 * Ray caster on the CPU: SIMD packets of the widest instruction set there is, tiles in parallel by
 * vtkSMPTools. The image does not depend on the number of threads. Draws every frame; reads the
 * mapper's tables where they are and counts their bytes once per version.
 */
class RayCastNative : public RayCastBackend
{
public:
  RayCastNative();

  std::string CanDraw(const RayCastRequest&) override { return std::string(); }
  bool IsRepeatable() const override { return true; }
  std::string Update(const RayCastRequest& request) override;
  std::string Cast(const RayCastRequest& request, RayCastTarget& target) override;
  RayCastStatistics GetStatistics() override;
  RayCastCounters GetCounters() override;

private:
  void UpdateProperty(const VolumePropertyTables& property);
  std::int64_t SizeOf(RayCastTable table, const RayCastTables& tables) const;
  /** Bytes of the tables of the transfer function. */
  std::int64_t GetPropertyBytes() const;
  TileCaster::Scene MakeScene(const RayCastRequest& request);
  /**
   * Casts the image, or the tiles of it in which a depth has changed.
   * @param depths  window depths in [0, 1], one per pixel, rows from below.
   * @param before  depths that the image was cast for, if the frame is the same otherwise, or null.
   */
  void BoundFilled(const TileCaster& caster);
  void CastTiles(const TileCaster::Scene& scene, const std::vector<float>& depths,
    const std::vector<float>* before);

  PacketTables Tables;
  FixedPointRays PlacedBy;
  TableVersions PlacedVersions;
  TableVersion PropertyVersion;
  TableCounter Counter;
  /** Image of the last frame, and the statistics of its tiles. */
  std::vector<float> Image;
  int ImageWidth = 0;
  /** Box around the pixels that are not zero. */
  RayCastImageBox Filled{ 0, 0, 0, 0 };
  std::vector<RayStatistics> OfTile;
  std::int64_t CastPixels = 0;
  InstructionSet Set;
};

/** Makes the backend of one mapper. */
std::unique_ptr<RayCastBackend> MakeNativeBackend(RayCastSharing& sharing);

}

#endif
