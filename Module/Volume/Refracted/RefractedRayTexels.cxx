// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractedRayTexels.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;

/** Line of a leg that a ray does not have. */
constexpr RefractedRayLine NoLine{ {}, {}, RefractedRayLine::Nowhere, 0.0f, 0.0f,
  128 << 8 | 128 << 16 };

/** Grid depth of a float, computed as in vtkTetrahedraRays.glsl. */
std::int32_t GridDepthOf(float depth)
{
  constexpr float largest = 1073741824.0f; // 2^30
  const float grid = depth * static_cast<float>(PacketVertex::GridPerDepth);
  return static_cast<std::int32_t>(std::clamp(grid, -largest, largest));
}

/**
 * Correction to that grid depth, plus 128: a float below 1 and its product are rounded to 2^-25.
 */
std::int32_t RestOf(double depth)
{
  const std::int32_t grid = GridDepthOf(static_cast<float>(depth));
  const bool atMesh = std::abs(depth) < 1.0;
  return 128 +
    (atMesh ? static_cast<std::int32_t>(std::lrint(depth * PacketVertex::GridPerDepth)) - grid : 0);
}

/** Line of leg number `number` of a ray. */
RefractedRayLine LineOf(
  const RayLegs& legs, const RefractionFrames& frames, int tile, int pixel, int number)
{
  RayLeg before;
  if (!legs.Find(tile, pixel, number - 1, before) ||
    !(before.End < std::numeric_limits<double>::infinity()))
  {
    return NoLine;
  }
  const glm::dvec3 sightPoint = before.Begin + (before.End - before.Depth) * before.Step;
  // The frame of the sight ray is the view's frame.
  const double end =
    number == 1 ? sightPoint.z : (frames.Get(frames.IndexOf(before.Step)).FromView * sightPoint).z;
  RefractedRayLine line{ {}, {}, static_cast<float>(end), 0.0f, 0.0f, RestOf(end) << 8 };
  RayLeg leg;
  if (legs.Find(tile, pixel, number, leg))
  {
    const int index = frames.IndexOf(leg.Step);
    const glm::dmat3& turn = frames.Get(index).FromView;
    const glm::dvec3 place = turn * leg.Begin;
    const glm::dvec3 step = turn * leg.Step;
    const FrameLine of = FrameLine::Through(place, step);
    frames.Get(index).Rays.GetFixedPointLine(of.Origin, of.Slope, line.Offset, line.Slope);
    line.Start = static_cast<float>(place.z);
    line.PerDepth = static_cast<float>(step.z);
    line.FrameAndRests |= index | RestOf(place.z) << 16;
  }
  return line;
}

/** Lays out the lines of one leg in a tile; `lines` has the lines of all pixels. */
void LayOutTile(const RayLegs& legs, const RefractionFrames& frames, int tile, int number,
  RefractedRayLine* lines)
{
  const bool any = number < legs.GetNumberOfLegs(tile);
  const int left = legs.GetLeft(tile);
  const int bottom = legs.GetBottom(tile);
  const int right = std::min(left + TileSize, legs.GetWidth());
  for (int row = bottom; row < std::min(bottom + TileSize, legs.GetHeight()); ++row)
  {
    RefractedRayLine* line = lines + std::int64_t{ row } * legs.GetWidth();
    for (int column = left; column < right; ++column)
    {
      const int pixel = (row - bottom) * TileSize + column - left;
      line[column] = any ? LineOf(legs, frames, tile, pixel, number) : NoLine;
    }
  }
}

}

//------------------------------------------------------------------------------
std::int32_t RefractedRayLine::GetGridEndBefore() const
{
  return GridDepthOf(this->EndBefore) + (this->FrameAndRests >> 8 & 255) - 128;
}

//------------------------------------------------------------------------------
std::int32_t RefractedRayLine::GetGridStart() const
{
  return GridDepthOf(this->Start) + (this->FrameAndRests >> 16 & 255) - 128;
}

//------------------------------------------------------------------------------
void LayOutRefractedRays(const RayLegs& legs, const RefractionFrames& frames, const RangeLoop& loop,
  std::vector<RefractedRayLine>& lines)
{
  const std::size_t pixels = static_cast<std::size_t>(legs.GetWidth()) * legs.GetHeight();
  lines.resize(pixels * static_cast<std::size_t>(legs.GetNumberOfLegs() - 1));
  ForEachItem(static_cast<std::size_t>(legs.GetNumberOfTiles()), loop,
    [&](std::size_t tile)
    {
      for (int number = 1; number < legs.GetNumberOfLegs(); ++number)
      {
        LayOutTile(legs, frames, static_cast<int>(tile), number,
          lines.data() + pixels * static_cast<std::size_t>(number - 1));
      }
    });
}

}
