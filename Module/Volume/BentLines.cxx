// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/BentLines.h"

#include <algorithm>
#include <cstddef>

namespace meniscus
{
namespace
{

constexpr int TileSize = MembraneSight::TileSize;

BentLine LineOf(const BentRay& ray, const glm::dvec2& pixel, const MembraneSight::View& view,
  const BentFrames& frames)
{
  BentLine line{ {}, {}, static_cast<float>(ray.Depth), 0.0f, 0.0f, 0.0f };
  if (ray.GoesOn())
  {
    const int index = frames.IndexOf(ray.Step);
    const glm::dmat3& turn = frames.Get(index).FromView;
    const glm::dvec2 across =
      view.Frame.Origin.At(pixel.x, pixel.y) + ray.Depth * view.Frame.Slope.At(pixel.x, pixel.y);
    const glm::dvec3 place = turn * glm::dvec3(across, ray.Depth);
    const glm::dvec3 step = turn * ray.Step;
    const FrameLine of = FrameLine::Through(place, step);
    for (int axis = 0; axis < 2; ++axis)
    {
      line.Origin[axis] = static_cast<float>(of.Origin[axis]);
      line.Slope[axis] = static_cast<float>(of.Slope[axis]);
    }
    line.Start = static_cast<float>(place.z);
    line.PerDepth = static_cast<float>(step.z);
    line.Frame = static_cast<float>(index);
  }
  return line;
}

}

//------------------------------------------------------------------------------
void LayOutBentLines(const MembraneSight& sight, const BentFrames& frames, const RangeLoop& loop,
  std::vector<BentLine>& lines)
{
  const MembraneSight::View& view = sight.GetView();
  const auto width = static_cast<std::size_t>(view.Width);
  lines.resize(width * static_cast<std::size_t>(view.Height));
  const int columns = (view.Width + TileSize - 1) / TileSize;
  constexpr BentLine straight{ {}, {}, BentLine::Nowhere, 0.0f, 0.0f, 0.0f };
  const auto layOutTile = [&](int tile)
  {
    const BentRay* rays = sight.GetTile(tile);
    const int left = tile % columns * TileSize;
    const int bottom = tile / columns * TileSize;
    const int right = std::min(left + TileSize, view.Width);
    for (int row = bottom; row < std::min(bottom + TileSize, view.Height); ++row)
    {
      BentLine* line = &lines[static_cast<std::size_t>(row) * width];
      for (int column = left; column < right; ++column)
      {
        const BentRay* ray = rays ? rays + (row - bottom) * TileSize + column - left : nullptr;
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
