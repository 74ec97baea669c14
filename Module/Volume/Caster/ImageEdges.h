// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Entries/BoundaryRaster.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Height of a step that is not an edge. At a step of height h, anywhere in a pixel, a single ray
 * differs from the pixel's mean colour by a number between 0 and h / 2, by h / sqrt(12) in the
 * quadratic mean: that is 2 of 255 levels.
 */
constexpr float EdgeThreshold = 2.0f * 3.4641016f / 255.0f;

/** Changes of red, green and blue of a picture over a black and over a white background. */
struct ColorChange
{
  float OverBlack[3];
  float OverWhite[3];

  /** A change of premultiplied colours. @param component returns it for 0 to 3, RGBA. */
  template <class Component>
  static ColorChange Of(const Component& component)
  {
    const float opacity = component(3);
    ColorChange change;
    for (int i = 0; i < 3; ++i)
    {
      change.OverBlack[i] = component(i);
      change.OverWhite[i] = change.OverBlack[i] - opacity;
    }
    return change;
  }

  /** The square of the change's height: the quadratic mean over the background that shows it best.
   */
  float GetSquare() const
  {
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i)
    {
      const float black = this->OverBlack[i] * this->OverBlack[i];
      const float white = this->OverWhite[i] * this->OverWhite[i];
      sum += black > white ? black : white;
    }
    return sum * (1.0f / 3.0f);
  }
};

/**
 * A pixel and its neighbours as one number: 0 for no edge, otherwise the height of the step on a
 * logarithmic scale, and the diagonal along which the colour changes more.
 */
class PixelEdge
{
public:
  /** Levels of a height and its double. */
  static constexpr int LevelsPerOctave = 8;
  static constexpr int HighestLevel = 127;

  PixelEdge() = default;
  explicit PixelEdge(std::uint8_t code)
    : Code(code)
  {
  }
  /** @param height of the step, above EdgeThreshold. */
  static PixelEdge Make(float height, bool isFalling);

  /** From 1 on: EdgeThreshold times 2^(level / LevelsPerOctave) is the height, rounded upwards. */
  int GetLevel() const { return this->Code & HighestLevel; }
  /** True for the diagonal from the upper left to the lower right. */
  bool IsFalling() const { return this->Code > HighestLevel; }
  std::uint8_t GetCode() const { return this->Code; }

private:
  std::uint8_t Code = 0;
};

/** Smallest height whose level is above the given one. */
float StepOfLevel(int level);

/**
 * Finds the pixels of an image for which one ray is not enough: their colour differs from the mean
 * of two opposite neighbours, in one of the four directions, by more than EdgeThreshold / 2 in
 * height. A step of a colour between two pixels changes both of these differences by its height,
 * a linear change none. The mean colour of a pixel at a step differs from one of the two colours by
 * at most half of the height.
 * @param rgba premultiplied colours, four numbers per pixel, rows from below.
 * @param filled pixels outside of this box are zero.
 * @param edges the code of each pixel's PixelEdge. Images with a single row or column have the
 *   highest edges everywhere.
 */
void FindImageEdges(const std::vector<float>& rgba, int width, int height,
  const BoundaryRaster::PixelBox& filled, const RangeLoop& loop, std::vector<std::uint8_t>& edges);

/**
 * Level up to which edges get no further rays, so that the others get no more rays than the image
 * has, by estimate: pictures that consist of edges would take several times as long otherwise. It
 * is limited by the error of the picture, which stays below 2 of 255 levels in the quadratic mean
 * of all pixels, by estimate, too.
 * @param edges as FindImageEdges() sets them.
 * @param rays rays of the image that met the mesh.
 * @param across a pixel has a square of at most so many rays in a row.
 */
int ChooseEdgeLevel(const std::vector<std::uint8_t>& edges, std::int64_t rays, int across);

/**
 * Adds a twelfth of the second differences across and along to the pixels of a box that have an
 * edge, but get no further rays. A pixel's mean exceeds its middle by 1/24 of them where the colour
 * is quadratic, and by 1/8 at a step somewhere between two pixels, in the mean.
 * @param rgba,edges as for FindImageEdges().
 * @param tolerated see ChooseEdgeLevel().
 * @param smooth an image with the pixels of `rgba`, which are changed.
 */
void SmoothEdges(const std::vector<float>& rgba, int width, int height,
  const std::vector<std::uint8_t>& edges, int tolerated, const BoundaryRaster::PixelBox& box,
  std::vector<float>& smooth);

}
