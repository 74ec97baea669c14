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

/// Whether the pixel differs from the one at an offset; false where the picture ends.
bool differsFromNeighbor(const ByteImage& image, int x, int y, int right, int up)
{
  const int i = x + right;
  const int j = y + up;
  return i >= 0 && i < image.Width && j >= 0 && j < image.Height &&
    isDifferent(image.pixel(x, y), image.pixel(i, j));
}

bool isEdge(const ByteImage& image, int x, int y)
{
  for (int up = -1; up <= 1; ++up)
  {
    for (int right = -1; right <= 1; ++right)
    {
      if (differsFromNeighbor(image, x, y, right, up))
      {
        return true;
      }
    }
  }
  return false;
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
      const bool isWrong = isDifferent(picture.pixel(x, y), reference.pixel(x, y));
      const bool onEdge = isEdge(reference, x, y);
      ++result.Pixels;
      result.Different += isWrong;
      result.EdgePixels += onEdge;
      result.DifferentOffEdges += isWrong && !onEdge;
      result.EdgeLength += differsFromNeighbor(reference, x, y, 1, 0);
      result.EdgeLength += differsFromNeighbor(reference, x, y, 0, 1);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
double largestDifference(const PictureComparison& comparison, double offset)
{
  const double expected = comparison.EdgeLength * offset;
  return expected + 3.0 * std::sqrt(expected);
}

} // namespace test
} // namespace meniscus
