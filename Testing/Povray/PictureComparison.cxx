// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureComparison.h"

namespace meniscus::test
{

namespace
{

bool IsDifferent(const unsigned char* a, const unsigned char* b)
{
  int largest = 0;
  for (int c = 0; c < 3; ++c)
  {
    largest = std::max(largest, std::abs(int(a[c]) - int(b[c])));
  }
  return largest > PictureComparison::Threshold;
}

/** True if one of the eight neighbours differs. */
bool IsEdge(const ByteImage& reference, int x, int y)
{
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, reference.Height - 1); ++j)
  {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, reference.Width - 1); ++i)
    {
      if (IsDifferent(reference.GetPixel(i, j), reference.GetPixel(x, y)))
      {
        return true;
      }
    }
  }
  return false;
}

/** Number of pairs that the pixel differs in: with its neighbours to the right and above. */
int CountEdges(const ByteImage& reference, int x, int y)
{
  const unsigned char* const color = reference.GetPixel(x, y);
  const bool right = x + 1 < reference.Width && IsDifferent(color, reference.GetPixel(x + 1, y));
  const bool above = y + 1 < reference.Height && IsDifferent(color, reference.GetPixel(x, y + 1));
  return int(right) + int(above);
}

} // anonymous namespace

//------------------------------------------------------------------------------
double PictureComparison::GetFraction() const
{
  return this->Pixels > 0 ? double(this->Different.size()) / this->Pixels : 0.0;
}

//------------------------------------------------------------------------------
double PictureComparison::FractionOffEdges() const
{
  return this->Pixels > 0 ? double(this->DifferentOffEdges) / this->Pixels : 0.0;
}

//------------------------------------------------------------------------------
PictureComparison ComparePictures(const ByteImage& picture, const ByteImage& reference)
{
  PictureComparison result;
  for (int y = 0; y < reference.Height; ++y)
  {
    for (int x = 0; x < reference.Width; ++x)
    {
      const bool onEdge = IsEdge(reference, x, y);
      ++result.Pixels;
      result.EdgePixels += onEdge;
      result.EdgeLength += CountEdges(reference, x, y);
      if (IsDifferent(picture.GetPixel(x, y), reference.GetPixel(x, y)))
      {
        result.Different.push_back({ x, y });
        result.DifferentOffEdges += !onEdge;
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
bool IsExplained(const unsigned char* pixel, const ByteImage& closeUp, const ObjectColors& object)
{
  bool hasObject = false;
  bool hasOther = false;
  for (std::size_t i = 0; i < closeUp.Rgb.size(); i += 3)
  {
    const unsigned char* const color = &closeUp.Rgb[i];
    if (!IsDifferent(color, pixel))
    {
      return true;
    }
    const bool isObjects = std::any_of(object.begin(), object.end(),
      [color](const auto& one) { return !IsDifferent(color, one.data()); });
    hasObject = hasObject || isObjects;
    hasOther = hasOther || !isObjects;
  }
  return hasObject && hasOther;
}

//------------------------------------------------------------------------------
double LargestDifference(const PictureComparison& comparison, double offset, double area)
{
  const double expected = comparison.EdgeLength * offset + area;
  return expected + 3.0 * std::sqrt(expected);
}

} // namespace meniscus::test
