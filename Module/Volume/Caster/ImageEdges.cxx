// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/ImageEdges.h"

#include <algorithm>
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

/** Largest second difference of a number in the four directions. `left`, `right`: offsets. */
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

/** Marks the edges in the columns [left, right) of a row of an image. */
void MarkRow(const ThreeRows& rows, int width, int left, int right, std::vector<float>& differences,
  std::uint8_t* edges)
{
  const auto mark = [edges, &differences](int column)
  {
    const float* difference = differences.data() + std::ptrdiff_t{ 4 } * column;
    const float largest =
      std::max(std::max(difference[0], difference[1]), std::max(difference[2], difference[3]));
    edges[column] = largest > EdgeThreshold ? 1 : 0;
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
    mark(column);
  }
}

}

//------------------------------------------------------------------------------
void FindImageEdges(const std::vector<float>& rgba, int width, int height,
  const BoundaryRaster::PixelBox& filled, const RangeLoop& loop, std::vector<std::uint8_t>& edges)
{
  const bool isLine = width == 1 || height == 1;
  edges.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), isLine ? 1 : 0);
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

}
