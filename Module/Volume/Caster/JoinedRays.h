// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Caster/LegBatch.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Rays/RayStatistics.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace meniscus
{

/**
 * The rays of a tile, joined from the legs that have been cast so far. Pixels are numbered in rows
 * of RefractedRayTiles::TileSize.
 */
class JoinedRays
{
public:
  /** Starts with rays that have met nothing and are outside of the mesh. */
  void Clear(BlendMode mode);

  /** True if nothing behind the end of the ray would be seen. */
  bool IsHidden(std::int32_t pixel, const PacketJob& job) const
  {
    return this->Hides &&
      !(this->Values[static_cast<std::size_t>(pixel)][3] > job.TerminationTransmittance);
  }

  /** Place of the end of the last leg: PacketResult::End. */
  std::int32_t GetEnd(std::int32_t pixel) const
  {
    return this->Ends[static_cast<std::size_t>(pixel)];
  }
  void SetEnd(std::int32_t pixel, std::int32_t end)
  {
    this->Ends[static_cast<std::size_t>(pixel)] = end;
  }
  /** Passes a leg without casting it, so that nothing is known about the places of its ends. */
  void SkipLeg() { this->Ends.fill(PacketResult::Somewhere); }

  /** Adds crossed cells. */
  void AddSteps(std::int32_t pixel, std::int32_t steps)
  {
    this->Steps[static_cast<std::size_t>(pixel)] += steps;
  }
  std::int32_t GetSteps(std::int32_t pixel) const
  {
    return this->Steps[static_cast<std::size_t>(pixel)];
  }
  /** Joins the values of a leg to the values of the legs in front of it. */
  void Join(const LegBatch::Origin& origin, BlendMode mode, const PacketResult& result);
  /** Sets the ray's end to a leg's end, which is unknown if the leg ends before its interface. */
  void EndAt(const LegBatch::Origin& origin, const PacketResult& result)
  {
    this->SetEnd(origin.Pixel, origin.ReachesInterface ? result.End : PacketResult::Somewhere);
  }

  /**
   * Converts the values of the rays that entered the mesh to premultiplied RGBA, and counts rays
   * and steps.
   * @param box pixels of the tile in the image, which has the given width.
   */
  void Finish(const PacketJob& job, const BoundaryRaster::PixelBox& box, int width, float* image,
    RayStatistics& sums) const;

private:
  static constexpr std::size_t Pixels =
    std::size_t{ BoundaryRaster::TileSize } * BoundaryRaster::TileSize;
  std::array<std::array<float, 4>, Pixels> Values;
  std::array<std::int32_t, Pixels> Ends;
  /** Number of cells crossed so far. */
  std::array<std::int32_t, Pixels> Steps;
  bool Hides = false;
};

}
