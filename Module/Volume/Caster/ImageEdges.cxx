// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/ImageEdges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

/** Three rows of an image; the outer ones are the middle one at the image's lower and upper end. */
struct ThreeRows
{
  const float* Below;
  const float* Middle;
  const float* Above;
};

/** Numbers between a pixel and its left and right neighbours; 0 at the image's border. */
struct Neighbours
{
  std::ptrdiff_t Left;
  std::ptrdiff_t Right;
};

/** Second difference of a number between two opposite neighbours. */
inline float SecondDifference(const float* before, const float* middle, const float* after)
{
  return *before + *after - 2.0f * *middle;
}

/** Largest second difference of a number in the four directions. */
inline float LargestDifference(
  const ThreeRows& rows, std::ptrdiff_t i, std::ptrdiff_t left, std::ptrdiff_t right)
{
  const float middle = 2.0f * rows.Middle[i];
  const float across = std::fabs(rows.Middle[i + left] + rows.Middle[i + right] - middle);
  const float along = std::fabs(rows.Below[i] + rows.Above[i] - middle);
  const float rising = std::fabs(rows.Below[i + left] + rows.Above[i + right] - middle);
  const float falling = std::fabs(rows.Above[i + left] + rows.Below[i + right] - middle);
  return std::max(std::max(across, along), std::max(rising, falling));
}

/** Squared height of the second differences of a pixel between two opposite neighbours. */
inline float SquaredHeight(const float* before, const float* middle, const float* after)
{
  return ColorChange::Of([=](int i) { return SecondDifference(before + i, middle + i, after + i); })
    .GetSquare();
}

/** Edge of the pixel whose numbers begin at i. */
PixelEdge EdgeOf(const ThreeRows& rows, std::ptrdiff_t i, const Neighbours& next)
{
  const float* middle = rows.Middle + i;
  const float across = SquaredHeight(middle + next.Left, middle, middle + next.Right);
  const float along = SquaredHeight(rows.Below + i, middle, rows.Above + i);
  const float rising =
    SquaredHeight(rows.Below + i + next.Left, middle, rows.Above + i + next.Right);
  const float falling =
    SquaredHeight(rows.Above + i + next.Left, middle, rows.Below + i + next.Right);
  const float largest = std::max(std::max(across, along), std::max(rising, falling));
  return largest > EdgeThreshold * EdgeThreshold
    ? PixelEdge::Make(std::sqrt(largest), falling > rising)
    : PixelEdge();
}

/** Finds the edges in the columns [left, right) of a row of an image. */
void MarkRow(const ThreeRows& rows, int width, int left, int right, std::vector<float>& differences,
  std::uint8_t* edges)
{
  const auto neighbours = [width](int column) {
    return Neighbours{ column > 0 ? -4 : 0, column < width - 1 ? 4 : 0 };
  };
  const std::ptrdiff_t begin = std::ptrdiff_t{ 4 } * std::max(left, 1);
  const std::ptrdiff_t end = std::ptrdiff_t{ 4 } * std::min(right, width - 1);
  for (std::ptrdiff_t i = begin; i < end; ++i)
  {
    differences[static_cast<std::size_t>(i)] = LargestDifference(rows, i, -4, 4);
  }
  for (std::ptrdiff_t i = 0; i < 4; ++i)
  {
    differences[static_cast<std::size_t>(i)] = LargestDifference(rows, i, 0, 4);
    const std::ptrdiff_t last = std::ptrdiff_t{ 4 } * (width - 1) + i;
    differences[static_cast<std::size_t>(last)] = LargestDifference(rows, last, -4, 0);
  }
  for (int column = left; column < right; ++column)
  {
    const std::ptrdiff_t i = std::ptrdiff_t{ 4 } * column;
    const float* difference = differences.data() + i;
    // The height of a change is at most that of its largest colour and of its opacity together.
    const float bound =
      std::max(std::max(difference[0], difference[1]), difference[2]) + difference[3];
    edges[column] =
      bound > EdgeThreshold ? EdgeOf(rows, i, neighbours(column)).GetCode() : std::uint8_t{ 0 };
  }
}

/**
 * Rays that a pixel gets in the mean (PixelRays), by the level of its edge above the tolerated one,
 * if it may get 16; of fewer, it gets as large a share of all rays at most. Measured on
 * isosurfaces, narrow peaks and shadows of two meshes: there, they differ by less than a third from
 * picture to picture, and by less than a tenth for twice the tolerance.
 */
double MeanNumberOfRays(int level, int across)
{
  constexpr int octave = PixelEdge::LevelsPerOctave;
  if (level <= 0)
  {
    return 0.0;
  }
  const double highest = 9.0 / 16.0 * across * across;
  return std::min(level <= octave ? 2.2
      : level <= 2 * octave       ? 4.4
      : level <= 4 * octave       ? 6.5
                                  : 9.0,
    highest);
}

/** Number of pixels by the level of their edge. */
using EdgeCounts = std::array<std::int64_t, PixelEdge::HighestLevel + 1>;

/** Further rays, as a share of those of the image, above which the tolerated level is raised. */
constexpr double LargestShareOfRays = 0.8;

/** Error of a picture up to which it is raised, as a share of 2 levels. */
constexpr double LargestError = 0.97;

/**
 * Square of the error that a pixel keeps in the mean, in units of that of a single ray at a step of
 * EdgeThreshold, by the level of its edge and the tolerated one. Measured in the same pictures, in
 * those that consist of edges. At a step between two pixels one of them is right, so that pixels
 * without further rays (SmoothEdges()) keep less than the square of their step. The rays of others
 * differ by less than is tolerated, in most of them by much less, but for those that get more than
 * four rays.
 */
double SquaredErrorOf(int level, int tolerated)
{
  const double square =
    std::exp2(2.0 * std::min(level, tolerated) / double{ PixelEdge::LevelsPerOctave });
  const bool isHigh = level - tolerated > 2 * PixelEdge::LevelsPerOctave;
  return square * (level <= 0 ? 0.0 : level <= tolerated ? 0.25 : isHigh ? 0.6 : 0.17);
}

/** Sum of an estimate for pixels with an edge, by its level. */
template <class Estimate>
double SumOver(const EdgeCounts& pixels, const Estimate& estimate)
{
  double sum = 0.0;
  for (int level = 1; level <= PixelEdge::HighestLevel; ++level)
  {
    sum += estimate(level) * static_cast<double>(pixels[static_cast<std::size_t>(level)]);
  }
  return sum;
}

}

//------------------------------------------------------------------------------
PixelEdge PixelEdge::Make(float height, bool isFalling)
{
  const float octaves = std::log2(height * (1.0f / EdgeThreshold));
  const int level = static_cast<int>(std::ceil(octaves * LevelsPerOctave));
  const int inside = std::min(std::max(level, 1), HighestLevel);
  return PixelEdge(static_cast<std::uint8_t>(inside + (isFalling ? HighestLevel + 1 : 0)));
}

//------------------------------------------------------------------------------
float StepOfLevel(int level)
{
  return EdgeThreshold * std::exp2(static_cast<float>(level) / PixelEdge::LevelsPerOctave);
}

//------------------------------------------------------------------------------
void FindImageEdges(const std::vector<float>& rgba, int width, int height,
  const BoundaryRaster::PixelBox& filled, const RangeLoop& loop, std::vector<std::uint8_t>& edges)
{
  const bool isLine = width == 1 || height == 1;
  edges.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
    isLine ? PixelEdge::HighestLevel : 0);
  if (isLine || filled.IsEmpty())
  {
    return;
  }
  const int left = std::max(filled.Left - 1, 0);
  const int right = std::min(filled.Right + 1, width);
  const int bottom = std::max(filled.Bottom - 1, 0);
  const int top = std::min(filled.Top + 1, height);
  constexpr int rowsOfBlock = 32;
  loop(static_cast<std::size_t>((top - bottom + rowsOfBlock - 1) / rowsOfBlock),
    [&](std::size_t first, std::size_t last)
    {
      std::vector<float> differences(std::size_t{ 4 } * static_cast<std::size_t>(width));
      const int end = std::min(bottom + static_cast<int>(last) * rowsOfBlock, top);
      for (int row = bottom + static_cast<int>(first) * rowsOfBlock; row < end; ++row)
      {
        const auto rowAt = [&](int number)
        {
          const int inside = std::min(std::max(number, 0), height - 1);
          return rgba.data() + std::ptrdiff_t{ 4 } * inside * width;
        };
        MarkRow({ rowAt(row - 1), rowAt(row), rowAt(row + 1) }, width, left, right, differences,
          edges.data() + std::ptrdiff_t{ row } * width);
      }
    });
}

//------------------------------------------------------------------------------
void SmoothEdges(const std::vector<float>& rgba, int width, int height,
  const std::vector<std::uint8_t>& edges, int tolerated, const BoundaryRaster::PixelBox& box,
  std::vector<float>& smooth)
{
  constexpr float share = 1.0f / 12.0f;
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const std::ptrdiff_t first = std::ptrdiff_t{ row } * width;
    const std::ptrdiff_t below = row > 0 ? std::ptrdiff_t{ -4 } * width : 0;
    const std::ptrdiff_t above = row < height - 1 ? std::ptrdiff_t{ 4 } * width : 0;
    for (int column = box.Left; column < box.Right; ++column)
    {
      const int level = PixelEdge(edges[static_cast<std::size_t>(first + column)]).GetLevel();
      if (level == 0 || level > tolerated)
      {
        continue;
      }
      const std::ptrdiff_t left = column > 0 ? -4 : 0;
      const std::ptrdiff_t right = column < width - 1 ? 4 : 0;
      for (std::ptrdiff_t i = 4 * (first + column); i < 4 * (first + column) + 4; ++i)
      {
        const float* middle = rgba.data() + i;
        smooth[static_cast<std::size_t>(i)] = *middle +
          share *
            (SecondDifference(middle + left, middle, middle + right) +
              SecondDifference(middle + below, middle, middle + above));
      }
    }
  }
}

//------------------------------------------------------------------------------
int ChooseEdgeLevel(const std::vector<std::uint8_t>& edges, std::int64_t rays, int across)
{
  EdgeCounts pixels{};
  for (const std::uint8_t edge : edges)
  {
    if (edge != 0)
    {
      ++pixels[static_cast<std::size_t>(PixelEdge(edge).GetLevel())];
    }
  }
  const double largestError = LargestError * LargestError * static_cast<double>(edges.size());
  const double wantedRays = LargestShareOfRays * static_cast<double>(rays);
  const auto errorOf = [&pixels](int tolerated)
  { return SumOver(pixels, [tolerated](int level) { return SquaredErrorOf(level, tolerated); }); };
  const auto raysOf = [&pixels, across](int tolerated)
  {
    return SumOver(pixels,
      [tolerated, across](int level) { return MeanNumberOfRays(level - tolerated, across); });
  };
  int level = 0;
  while (level < PixelEdge::HighestLevel && raysOf(level) > wantedRays &&
    errorOf(level + 1) <= largestError)
  {
    ++level;
  }
  return level;
}

}
