// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/InterpolatedRays.h"

#include "Volume/Caster/ImageEdges.h"
#include "Volume/Caster/TileCurve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr TileCurve Curve;

/**
 * Second difference above which all rays of a quarter are cast at once. At half the distance, those
 * of a colour that changes smoothly are a fourth, and others more.
 */
constexpr float LargestDividedDifference = 4.0f * LargestInterpolatedDifference;

/** Height of the second difference of three colours. @param ratio as in Three. */
float HeightOf(const float* first, const float* middle, const float* last, float ratio)
{
  if (ratio == 0.0f)
  {
    return std::numeric_limits<float>::infinity();
  }
  const auto second = [=](int i) { return (last[i] - middle[i]) * ratio - (middle[i] - first[i]); };
  return std::sqrt(ColorChange::Of(second).GetSquare());
}

}

//------------------------------------------------------------------------------
/** Rays of a square along a side that begins at a column or row. @param last one of the tile. */
InterpolatedRays::Three InterpolatedRays::Divide(int begin, int last) const
{
  const int middle = std::min(begin + this->Side / 2, last);
  const int end = std::min(begin + this->Side, last);
  return { { begin, middle, end },
    end > middle ? static_cast<float>(middle - begin) / static_cast<float>(end - middle) : 0.0f };
}

//------------------------------------------------------------------------------
/** Selects a ray that is not known. One that does not enter the mesh has no colour. */
void InterpolatedRays::Select(int column, int row)
{
  const std::size_t number = NumberOf(column, row);
  if (this->Known[number] == 0 && this->EntriesOf(column, row) > 0)
  {
    std::fill_n(this->ColorOf(column, row), 4, 0.0f);
    this->Selected.push_back(static_cast<std::int16_t>(number));
    ++this->NumberOfSelected;
  }
  this->Known[number] = 1;
}

//------------------------------------------------------------------------------
void InterpolatedRays::SelectSquare(const Square& square)
{
  const Three columns = this->Divide(square.Column, this->LastColumn);
  const Three rows = this->Divide(square.Row, this->LastRow);
  for (const int row : rows.At)
  {
    for (const int column : columns.At)
    {
      this->Select(column, row);
    }
  }
}

//------------------------------------------------------------------------------
void InterpolatedRays::SelectAll(const Quarter& quarter)
{
  for (int row = quarter.Bottom; row <= quarter.Top; ++row)
  {
    for (int column = quarter.Left; column <= quarter.Right; ++column)
    {
      this->Select(column, row);
    }
  }
}

//------------------------------------------------------------------------------
void InterpolatedRays::Begin(const Tile& tile)
{
  this->Input = tile;
  this->LastColumn = tile.Box.Right - tile.Box.Left - 1;
  this->LastRow = tile.Box.Top - tile.Box.Bottom - 1;
  this->Side = FirstSide;
  this->Squares.clear();
  this->Known.assign(std::size_t{ TileSize } * TileSize, 0);
  this->Selected.clear();
  this->NumberOfSelected = 0;
  constexpr std::size_t across = TileSize / FirstSide;
  for (std::size_t i = 0; i < across * across; ++i)
  {
    const Square square{ FirstSide * (Curve[i] % TileSize), FirstSide * (Curve[i] / TileSize) };
    if (square.Column <= this->LastColumn && square.Row <= this->LastRow)
    {
      this->Squares.push_back(square);
      this->SelectSquare(square);
    }
  }
}

//------------------------------------------------------------------------------
/** Second differences of a square along its three rows and its three columns. */
void InterpolatedRays::SetDifferences(
  const Three& columns, const Three& rows, float* across, float* along) const
{
  for (int i = 0; i < 3; ++i)
  {
    const int row = rows.At[i];
    across[i] = HeightOf(this->ColorOf(columns.At[0], row), this->ColorOf(columns.At[1], row),
      this->ColorOf(columns.At[2], row), columns.Ratio);
    const int column = columns.At[i];
    along[i] = HeightOf(this->ColorOf(column, rows.At[0]), this->ColorOf(column, rows.At[1]),
      this->ColorOf(column, rows.At[2]), rows.Ratio);
  }
}

//------------------------------------------------------------------------------
/** True if rays end at the same depth where the window has these depths. */
bool InterpolatedRays::HaveOneEnd(float depth, float other) const
{
  const RayFrame* frame = this->Input.Frame;
  return other == depth || (frame && frame->EndAt(other) == frame->EndAt(depth));
}

//------------------------------------------------------------------------------
/** True if the rays of a quarter enter the mesh equally often and end at the same depth. */
bool InterpolatedRays::AreAlike(const Quarter& quarter) const
{
  const auto depthAt = [this](int column, int row)
  { return this->Input.OpaqueDepth ? this->Input.OpaqueDepth[this->PixelOf(column, row)] : 1.0f; };
  const std::int32_t entries = this->EntriesOf(quarter.Left, quarter.Bottom);
  const float depth = depthAt(quarter.Left, quarter.Bottom);
  for (int row = quarter.Bottom; row <= quarter.Top; ++row)
  {
    for (int column = quarter.Left; column <= quarter.Right; ++column)
    {
      if (this->EntriesOf(column, row) != entries || !this->HaveOneEnd(depth, depthAt(column, row)))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** Interpolates the rays of a quarter that are not known between its corners. */
void InterpolatedRays::Interpolate(const Quarter& quarter)
{
  const float* const corners[4] = { this->ColorOf(quarter.Left, quarter.Bottom),
    this->ColorOf(quarter.Right, quarter.Bottom), this->ColorOf(quarter.Left, quarter.Top),
    this->ColorOf(quarter.Right, quarter.Top) };
  const float perColumn = 1.0f / static_cast<float>(std::max(quarter.Right - quarter.Left, 1));
  const float perRow = 1.0f / static_cast<float>(std::max(quarter.Top - quarter.Bottom, 1));
  for (int row = quarter.Bottom; row <= quarter.Top; ++row)
  {
    const float up = static_cast<float>(row - quarter.Bottom) * perRow;
    float begin[4];
    float step[4];
    for (int i = 0; i < 4; ++i)
    {
      begin[i] = corners[0][i] + up * (corners[2][i] - corners[0][i]);
      step[i] = (corners[1][i] + up * (corners[3][i] - corners[1][i]) - begin[i]) * perColumn;
    }
    for (int column = quarter.Left; column <= quarter.Right; ++column)
    {
      const float right = static_cast<float>(column - quarter.Left);
      for (int i = 0; this->Known[NumberOf(column, row)] == 0 && i < 4; ++i)
      {
        this->ColorOf(column, row)[i] = begin[i] + right * step[i];
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Interpolates the quarters of a square that are known well enough; divides or casts others. */
void InterpolatedRays::Refine(const Square& square)
{
  const Three columns = this->Divide(square.Column, this->LastColumn);
  const Three rows = this->Divide(square.Row, this->LastRow);
  float across[3];
  float along[3];
  this->SetDifferences(columns, rows, across, along);
  for (int number = 0; number < 4; ++number)
  {
    const int i = number % 2;
    const int j = number / 2;
    const Quarter quarter{ columns.At[i], columns.At[i + 1], rows.At[j], rows.At[j + 1] };
    const int width = quarter.Right - quarter.Left;
    const int height = quarter.Top - quarter.Bottom;
    // Only the first quarter of a side of a single ray has that ray.
    if (std::max(width, height) <= 1 || (i == 1 && width == 0) || (j == 1 && height == 0))
    {
      continue;
    }
    const float difference = std::max(across[j], across[j + 1]) + std::max(along[i], along[i + 1]);
    if (!(difference <= LargestDividedDifference))
    {
      this->SelectAll(quarter);
    }
    else if (difference > LargestInterpolatedDifference || !this->AreAlike(quarter))
    {
      this->Next.push_back({ quarter.Left, quarter.Bottom });
    }
    else
    {
      this->Interpolate(quarter);
    }
  }
}

//------------------------------------------------------------------------------
bool InterpolatedRays::SelectMore()
{
  this->Selected.clear();
  this->Next.clear();
  for (const Square& square : this->Squares)
  {
    this->Refine(square);
  }
  this->Squares.swap(this->Next);
  this->Side /= 2;
  for (const Square& square : this->Squares)
  {
    this->SelectSquare(square);
  }
  return !this->Squares.empty() || !this->Selected.empty();
}

//------------------------------------------------------------------------------
std::int64_t InterpolatedRays::GetNumberOfInterpolated() const
{
  std::int64_t entering = 0;
  for (int row = 0; row <= this->LastRow; ++row)
  {
    for (int column = 0; column <= this->LastColumn; ++column)
    {
      entering += this->EntriesOf(column, row) > 0 ? 1 : 0;
    }
  }
  return entering - this->NumberOfSelected;
}

}
