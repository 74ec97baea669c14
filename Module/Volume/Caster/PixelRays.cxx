// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/PixelRays.h"

#include "Volume/Caster/ImageEdges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

namespace meniscus
{
namespace
{

constexpr std::size_t RaysOfTile = std::size_t{ PixelRays::TileSize } * PixelRays::TileSize;

/**
 * Height of a step for which four rays are enough. They find the covered part of the pixel in steps
 * of 1/4, so that they have the error of a single ray at a step of a quarter of the height.
 */
constexpr float FewRaysThreshold = 4.0f * EdgeThreshold;

/** A rotated square of four rays in the square of a pixel's rays. */
std::array<int, 4> FirstRaysOf(int across)
{
  constexpr int rows[4] = { 1, 3, 0, 2 };
  const auto at = [across](int quarter) { return (2 * quarter + 1) * across / 8; };
  std::array<int, 4> rays{};
  for (int column = 0; column < 4; ++column)
  {
    rays[static_cast<std::size_t>(column)] = at(rows[column]) * PixelRays::TileSize + at(column);
  }
  return rays;
}

}

//------------------------------------------------------------------------------
void PixelRays::Begin(const BoundaryRaster::PixelBox& rays, int across,
  const std::uint8_t* selected, std::int64_t width)
{
  this->Across = across;
  this->FirstRays = FirstRaysOf(across);
  this->Pixels.clear();
  this->Selected.assign(RaysOfTile, 0);
  // A ray that misses the mesh has no colour.
  this->Colors.assign(4 * RaysOfTile, 0.0f);
  this->Wanted = { rays.Right, rays.Left, rays.Top, rays.Bottom };
  for (int bottom = rays.Bottom; bottom < rays.Top; bottom += across)
  {
    for (int left = rays.Left; left < rays.Right; left += across)
    {
      const std::int64_t pixel = bottom / across * width + left / across;
      if (selected[pixel] == 0)
      {
        continue;
      }
      const int first = (bottom - rays.Bottom) * TileSize + left - rays.Left;
      this->Pixels.push_back({ pixel, first, false });
      for (const int ray : this->FirstRays)
      {
        this->Selected[static_cast<std::size_t>(first + ray)] = 1;
      }
      this->Wanted = { std::min(this->Wanted.Left, left),
        std::max(this->Wanted.Right, left + across), std::min(this->Wanted.Bottom, bottom),
        std::max(this->Wanted.Top, bottom + across) };
    }
  }
}

//------------------------------------------------------------------------------
/** True if a number of the colours differs by no more than the threshold among the rays. */
bool PixelRays::FirstRaysAgree(const Pixel& pixel, const float* center) const
{
  for (int i = 0; i < 4; ++i)
  {
    float lowest = center[i];
    float highest = center[i];
    for (const int ray : this->FirstRays)
    {
      const float value = this->Colors[static_cast<std::size_t>(4 * (pixel.FirstRay + ray) + i)];
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    if (highest - lowest > FewRaysThreshold)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool PixelRays::SelectOthers(const float* image)
{
  std::fill(this->Selected.begin(), this->Selected.end(), std::uint8_t{ 0 });
  if (this->Across == 2)
  {
    return false; // the first rays are all rays
  }
  bool isAny = false;
  for (Pixel& pixel : this->Pixels)
  {
    pixel.HasAll = !this->FirstRaysAgree(pixel, image + 4 * pixel.InImage);
    if (!pixel.HasAll)
    {
      continue;
    }
    isAny = true;
    for (int row = 0; row < this->Across; ++row)
    {
      const auto first = this->Selected.begin() + pixel.FirstRay + std::ptrdiff_t{ row } * TileSize;
      std::fill_n(first, this->Across, std::uint8_t{ 1 });
    }
    for (const int ray : this->FirstRays)
    {
      this->Selected[static_cast<std::size_t>(pixel.FirstRay + ray)] = 0;
    }
  }
  return isAny;
}

//------------------------------------------------------------------------------
void PixelRays::Finish(float* image)
{
  for (const Pixel& pixel : this->Pixels)
  {
    float sum[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
    const auto add = [this, &pixel, &sum](int ray)
    {
      const float* color = this->Colors.data() + std::ptrdiff_t{ 4 } * (pixel.FirstRay + ray);
      std::transform(color, color + 4, sum, sum, std::plus<float>());
    };
    if (pixel.HasAll)
    {
      for (int ray = 0; ray < this->Across * this->Across; ++ray)
      {
        add(ray / this->Across * TileSize + ray % this->Across);
      }
    }
    else
    {
      std::for_each(this->FirstRays.begin(), this->FirstRays.end(), add);
    }
    const int count = pixel.HasAll ? this->Across * this->Across : 4;
    std::transform(sum, sum + 4, image + 4 * pixel.InImage,
      [count](float value) { return value / static_cast<float>(count); });
  }
}

}
