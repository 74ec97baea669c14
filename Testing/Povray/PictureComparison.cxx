// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureComparison.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace meniscus
{
namespace test
{

namespace
{

bool isDifferent(const unsigned char* a, const unsigned char* b)
{
  int largest = 0;
  for (int c = 0; c < 3; ++c)
  {
    largest = std::max(largest, std::abs(int(a[c]) - int(b[c])));
  }
  return largest > PictureComparison::Threshold;
}

/// Number of pixels among a pixel and its eight neighbours, and how many of them differ from a
/// colour.
struct Neighborhood
{
  int Pixels = 0;
  int Different = 0;
};

Neighborhood lookAround(const ByteImage& reference, int x, int y, const unsigned char* color)
{
  Neighborhood result;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, reference.Height - 1); ++j)
  {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, reference.Width - 1); ++i)
    {
      ++result.Pixels;
      result.Different += isDifferent(reference.pixel(i, j), color);
    }
  }
  return result;
}

/// Number of pairs that the pixel differs in: with its neighbours to the right and above.
int countEdges(const ByteImage& reference, int x, int y)
{
  const unsigned char* const color = reference.pixel(x, y);
  const bool right = x + 1 < reference.Width && isDifferent(color, reference.pixel(x + 1, y));
  const bool above = y + 1 < reference.Height && isDifferent(color, reference.pixel(x, y + 1));
  return int(right) + int(above);
}

} // anonymous namespace

//------------------------------------------------------------------------------
double PictureComparison::fraction() const
{
  return this->Pixels > 0 ? double(this->Different) / this->Pixels : 0.0;
}

//------------------------------------------------------------------------------
double PictureComparison::fractionOffEdges() const
{
  return this->Pixels > 0 ? double(this->DifferentOffEdges) / this->Pixels : 0.0;
}

//------------------------------------------------------------------------------
PictureComparison comparePictures(const ByteImage& picture, const ByteImage& reference)
{
  PictureComparison result;
  for (int y = 0; y < reference.Height; ++y)
  {
    for (int x = 0; x < reference.Width; ++x)
    {
      const unsigned char* const color = picture.pixel(x, y);
      const unsigned char* const truth = reference.pixel(x, y);
      const bool isEdge = lookAround(reference, x, y, truth).Different > 0;
      ++result.Pixels;
      result.EdgePixels += isEdge;
      result.EdgeLength += countEdges(reference, x, y);
      if (!isDifferent(color, truth))
      {
        continue;
      }
      ++result.Different;
      result.DifferentOffEdges += !isEdge;
      const Neighborhood around = lookAround(reference, x, y, color);
      if (around.Different == around.Pixels)
      {
        result.Foreign.push_back({ x, y });
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
bool hasColor(const ByteImage& picture, const unsigned char* color)
{
  for (std::size_t i = 0; i < picture.Rgb.size(); i += 3)
  {
    if (!isDifferent(&picture.Rgb[i], color))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
double largestDifference(const PictureComparison& comparison, double offset)
{
  const double expected = comparison.EdgeLength * offset;
  return expected + 3.0 * std::sqrt(expected);
}

} // namespace test
} // namespace meniscus
