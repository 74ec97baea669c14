// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/PixelRays.h"

#include "Volume/Caster/ImageEdges.h"
#include "Volume/Caster/TileCurve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

namespace meniscus
{
namespace
{

constexpr std::size_t RaysOfTile = std::size_t{ PixelRays::TileSize } * PixelRays::TileSize;

constexpr TileCurve Curve;

/** Rows of four rays in the four columns of a square: a rotated square, and its mirror image. */
constexpr int FirstFour[4] = { 1, 3, 0, 2 };
constexpr int NextFour[4] = { 2, 0, 3, 1 };

/** Steps up to twice the tolerated one begin with two rays, which are enough for them. */
constexpr int LevelOfTwoRays = PixelEdge::LevelsPerOctave;

/** Range of premultiplied colours, over a black and over a white background. */
class ColorRange
{
public:
  explicit ColorRange(const float* color)
    : Lowest(OverBackgrounds(color))
    , Highest(Lowest)
  {
  }
  void Add(const float* color)
  {
    const std::array<float, 6> shown = OverBackgrounds(color);
    for (std::size_t i = 0; i < shown.size(); ++i)
    {
      this->Lowest[i] = std::min(this->Lowest[i], shown[i]);
      this->Highest[i] = std::max(this->Highest[i], shown[i]);
    }
  }
  ColorChange GetChange() const
  {
    ColorChange change;
    for (std::size_t i = 0; i < 3; ++i)
    {
      change.OverBlack[i] = this->Highest[i] - this->Lowest[i];
      change.OverWhite[i] = this->Highest[i + 3] - this->Lowest[i + 3];
    }
    return change;
  }

private:
  static std::array<float, 6> OverBackgrounds(const float* color)
  {
    const float white = 1.0f - color[3];
    return { color[0], color[1], color[2], color[0] + white, color[1] + white, color[2] + white };
  }

  std::array<float, 6> Lowest;
  std::array<float, 6> Highest;
};

}

//------------------------------------------------------------------------------
/** Selects a ray of a pixel's square that is not known. */
void PixelRays::Select(Pixel& pixel, int row, int column)
{
  const auto ray = static_cast<std::size_t>(pixel.FirstRay + row * TileSize + column);
  if (this->Known[ray] == 0)
  {
    this->Known[ray] = 1;
    this->Selected.push_back(static_cast<std::int16_t>(ray));
    // A ray that misses the mesh has no colour.
    std::fill_n(this->Colors.begin() + static_cast<std::ptrdiff_t>(4 * ray), 4, 0.0f);
    ++pixel.Rays;
  }
}

//------------------------------------------------------------------------------
/** Selects four rays of a pixel by their rows in a square of 4 x 4. */
void PixelRays::SelectFour(Pixel& pixel, const int (&rows)[4])
{
  const auto at = [this](int quarter) { return (2 * quarter + 1) * this->Across / 8; };
  for (int column = 0; column < 4; ++column)
  {
    this->Select(pixel, at(rows[column]), at(column));
  }
}

//------------------------------------------------------------------------------
/** Selects the rays of a pixel's next round. */
void PixelRays::SelectNext(Pixel& pixel)
{
  switch (pixel.Next)
  {
    case Round::Four:
      this->SelectFour(pixel, FirstFour);
      pixel.Next = Round::Eight;
      return;
    case Round::Eight:
      this->SelectFour(pixel, NextFour);
      pixel.Next = Round::All;
      return;
    default:
      for (int ray = 0; ray < this->Across * this->Across; ++ray)
      {
        this->Select(pixel, ray / this->Across, ray % this->Across);
      }
      pixel.Next = Round::None;
  }
}

//------------------------------------------------------------------------------
void PixelRays::Begin(const BoundaryRaster::PixelBox& rays, int across, const std::uint8_t* edges,
  std::int64_t width, int level)
{
  this->Across = across;
  this->Tolerated = StepOfLevel(level);
  this->Pixels.clear();
  this->Selected.clear();
  this->Known.assign(RaysOfTile, 0);
  this->Colors.resize(4 * RaysOfTile);
  const int columns = (rays.Right - rays.Left) / across;
  const int rows = (rays.Top - rays.Bottom) / across;
  for (std::size_t i = 0; i < TileCurve::LengthOf(std::max(columns, rows)); ++i)
  {
    const int column = Curve[i] % TileSize;
    const int row = Curve[i] / TileSize;
    if (column < columns && row < rows)
    {
      const std::int64_t bottom = rays.Bottom / across;
      const std::int64_t number = (bottom + row) * width + rays.Left / across + column;
      this->BeginPixel(
        { number, across * (row * TileSize + column), 0, Round::Four }, edges[number], level);
    }
  }
}

//------------------------------------------------------------------------------
/** Selects the first rays of a pixel, if it is at an edge above the given level. */
void PixelRays::BeginPixel(const Pixel& begun, std::uint8_t code, int level)
{
  const PixelEdge edge(code);
  if (edge.GetLevel() <= level)
  {
    return;
  }
  Pixel& pixel = this->Pixels.emplace_back(begun);
  if (edge.GetLevel() - level > LevelOfTwoRays)
  {
    this->SelectNext(pixel);
    return;
  }
  const int last = this->Across - 1;
  this->Select(pixel, edge.IsFalling() ? last : 0, 0);
  this->Select(pixel, edge.IsFalling() ? 0 : last, last);
}

//------------------------------------------------------------------------------
/** Calls visit(colour) for each ray of a pixel that has been cast. */
template <class Visit>
void PixelRays::VisitRays(const Pixel& pixel, const Visit& visit) const
{
  for (int row = 0; row < this->Across; ++row)
  {
    const int first = pixel.FirstRay + row * TileSize;
    for (int ray = first; ray < first + this->Across; ++ray)
    {
      if (this->Known[static_cast<std::size_t>(ray)] != 0)
      {
        visit(this->Colors.data() + std::ptrdiff_t{ 4 } * ray);
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Square of the step between a pixel's rays, with the ray through its centre. */
float PixelRays::GetSquaredStep(const Pixel& pixel, const float* center) const
{
  ColorRange range(center);
  this->VisitRays(pixel, [&range](const float* color) { range.Add(color); });
  return range.GetChange().GetSquare();
}

//------------------------------------------------------------------------------
/** True if a step is one that a pixel's number of rays tolerates. */
bool PixelRays::IsTolerated(const Pixel& pixel, float squaredStep) const
{
  const float tolerated = static_cast<float>(pixel.Rays) * this->Tolerated;
  return squaredStep <= tolerated * tolerated;
}

//------------------------------------------------------------------------------
bool PixelRays::SelectMore(const float* image)
{
  this->Selected.clear();
  for (Pixel& pixel : this->Pixels)
  {
    if (pixel.Next == Round::None)
    {
      continue;
    }
    const float step = this->GetSquaredStep(pixel, image + 4 * pixel.InImage);
    const int before = pixel.Rays;
    // Further rays make the step no lower: where the next ones cannot be enough, those after them
    // are cast at the same time.
    while (pixel.Next != Round::None && !this->IsTolerated(pixel, step))
    {
      this->SelectNext(pixel);
    }
    pixel.Next = pixel.Rays > before ? pixel.Next : Round::None;
  }
  return !this->Selected.empty();
}

//------------------------------------------------------------------------------
/** Number of rays that the ray through a pixel's centre counts as. */
float PixelRays::WeightOfCenter(const Pixel& pixel) const
{
  if (pixel.Rays == this->Across * this->Across)
  {
    return 0.0f;
  }
  // Between two rays on a diagonal, it counts as much as for edges along a row, which are found
  // best if the three count alike, and for edges across the diagonal, in whose middle the pixel is
  // widest, if it counts twice. Four rays and more cover the pixel without it.
  return pixel.Rays == 2 ? 1.5f : 0.5f;
}

//------------------------------------------------------------------------------
void PixelRays::Finish(float* image)
{
  for (const Pixel& pixel : this->Pixels)
  {
    float* color = image + 4 * pixel.InImage;
    const float weight = this->WeightOfCenter(pixel);
    float sum[4];
    std::transform(color, color + 4, sum, [weight](float value) { return weight * value; });
    this->VisitRays(pixel,
      [&sum](const float* ray) { std::transform(ray, ray + 4, sum, sum, std::plus<float>()); });
    const float count = static_cast<float>(pixel.Rays) + weight;
    std::transform(sum, sum + 4, color, [count](float value) { return value / count; });
  }
}

}
