// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractedRayTexels.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayField::TileSize;

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

RefractedRayLine LineOf(const RefractedRay& ray, const glm::dvec2& pixel,
  const RefractedRayField::View& view, const RefractionFrames& frames)
{
  RefractedRayLine line{ {}, {}, static_cast<float>(ray.Depth), 0.0f, 0.0f,
    RestOf(ray.Depth) << 8 };
  if (ray.GoesOn())
  {
    const int index = frames.IndexOf(ray.Step);
    const glm::dmat3& turn = frames.Get(index).FromView;
    const glm::dvec2 across =
      view.Frame.Origin.At(pixel.x, pixel.y) + ray.Depth * view.Frame.Slope.At(pixel.x, pixel.y);
    const glm::dvec3 place = turn * glm::dvec3(across, ray.Depth);
    const glm::dvec3 step = turn * ray.Step;
    const FrameLine of = FrameLine::Through(place, step);
    frames.Get(index).Rays.GetFixedPointLine(of.Origin, of.Slope, line.Offset, line.Slope);
    line.Start = static_cast<float>(place.z);
    line.PerDepth = static_cast<float>(step.z);
    line.FrameAndRests |= index | RestOf(place.z) << 16;
  }
  return line;
}

}

//------------------------------------------------------------------------------
std::int32_t RefractedRayLine::GetGridMembraneDepth() const
{
  return GridDepthOf(this->MembraneDepth) + (this->FrameAndRests >> 8 & 255) - 128;
}

//------------------------------------------------------------------------------
std::int32_t RefractedRayLine::GetGridStart() const
{
  return GridDepthOf(this->Start) + (this->FrameAndRests >> 16 & 255) - 128;
}

//------------------------------------------------------------------------------
void LayOutRefractedRays(const RefractedRayField& sight, const RefractionFrames& frames,
  const RangeLoop& loop, std::vector<RefractedRayLine>& lines)
{
  const RefractedRayField::View& view = sight.GetView();
  const auto width = static_cast<std::size_t>(view.Width);
  lines.resize(width * static_cast<std::size_t>(view.Height));
  const int columns = (view.Width + TileSize - 1) / TileSize;
  constexpr RefractedRayLine straight{ {}, {}, RefractedRayLine::Nowhere, 0.0f, 0.0f,
    128 << 8 | 128 << 16 };
  const auto layOutTile = [&](int tile)
  {
    const RefractedRay* rays = sight.GetTile(tile);
    const int left = tile % columns * TileSize;
    const int bottom = tile / columns * TileSize;
    const int right = std::min(left + TileSize, view.Width);
    for (int row = bottom; row < std::min(bottom + TileSize, view.Height); ++row)
    {
      RefractedRayLine* line = &lines[static_cast<std::size_t>(row) * width];
      for (int column = left; column < right; ++column)
      {
        const RefractedRay* ray = rays ? rays + (row - bottom) * TileSize + column - left : nullptr;
        const glm::dvec2 pixel(column + 0.5 - 0.5 * view.Width, row + 0.5 - 0.5 * view.Height);
        line[column] = ray && ray->MeetsMembrane() ? LineOf(*ray, pixel, view, frames) : straight;
      }
    }
  };
  loop(static_cast<std::size_t>(sight.GetNumberOfTiles()),
    [&layOutTile](std::size_t begin, std::size_t end)
    {
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        layOutTile(static_cast<int>(tile));
      }
    });
}

}
