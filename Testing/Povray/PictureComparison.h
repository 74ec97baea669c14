// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ComparisonScene.h"
#include "VolumeScene.h"

namespace meniscus::test
{

/** Place of a pixel in a picture. */
struct PixelPlace
{
  int X = 0;
  int Y = 0;
};

/** Difference of a picture of flat colours from its reference. */
struct PictureComparison
{
  /** Pixels that are off by more than this in a channel are counted. */
  static constexpr int Threshold = 8;

  int Pixels = 0;
  /** Places of the different pixels. */
  std::vector<PixelPlace> Different;
  /** Pixels that differ from one of their eight neighbours in the reference. */
  int EdgePixels = 0;
  /** Different pixels that are no edge pixels. */
  int DifferentOffEdges = 0;
  /**
   * Pairs of neighbours in a row or a column that differ in the reference. At least the length of
   * all edges in pixels: an edge that leans by an angle a crosses |cos a| + |sin a| >= 1 of them
   * per pixel of length.
   */
  int EdgeLength = 0;

  double GetFraction() const;
  double FractionOffEdges() const;
};

/** Compares pixel against the same pixel; both pictures have the same size. */
PictureComparison ComparePictures(const ByteImage& picture, const ByteImage& reference);

/**
 * True if a displaced edge explains a pixel, after the reference's close-up around its middle: the
 * close-up has the pixel's colour; or it has the border of the object that has this colour (another
 * of its colours, and one that is not its), where a face that the object hides may come out on top.
 */
bool IsExplained(const unsigned char* pixel, const ByteImage& closeUp, const ObjectColors& object);

/**
 * Largest number of different pixels of a picture whose edges are off by at most `offset` pixels,
 * and another `area` of so many pixels may be wrong. A displaced edge sweeps an area of at most
 * length * offset, and as many middles of pixels are in it on average; three standard deviations of
 * that number as a Poisson variable are added.
 */
double LargestDifference(const PictureComparison& comparison, double offset, double area);

} // namespace meniscus::test
