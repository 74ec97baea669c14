// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Square pictures side by side, one row per case: drawn by the project, made by a reference, and
 * the difference of both. The figures in the documentation.
 */
#pragma once

#include "RefractionPicture.h"

class vtkImageData;

namespace meniscus::test
{

class ComparisonSheet
{
public:
  /** A white sheet; each picture has `side` x `side` pixels. */
  ComparisonSheet(int rows, int columns, int side);

  int GetSide() const { return this->Side; }

  /**
   * Rows are counted downwards, y upwards within a picture. Colours are clamped to 0 and 1 and
   * rounded to multiples of 1 / 51.
   */
  void SetPixel(int row, int column, int x, int y, const glm::dvec3& colour);

  void Write(const std::string& path) const;

private:
  static constexpr int Gap = 6; // pixels between pictures

  int Rows;
  int Side;
  vtkSmartPointer<vtkImageData> Image;
};

/** Colour of a place on an object. */
using PlaceColour = std::function<glm::dvec3(const glm::dvec3& place)>;

/** Colour of a pixel; a light grey where there is no object. */
glm::dvec3 GetColour(const PlacePixel& pixel, const PlaceColour& colour);

/**
 * Fills a row with the places that are drawn, those that are traced, and their difference: white
 * for equal places, black from half a pixel on (these pixels count), red where only one of the two
 * pictures shows the object. Prints and returns the comparison. The side of the pictures must be a
 * multiple of that of the sheet; the difference shows the largest one of several pixels.
 */
PlaceComparison AddComparison(ComparisonSheet& sheet, int row, const std::string& name,
  const PixelCamera& camera, const PlacePicture& drawn, const PlacePicture& traced,
  const PlaceColour& colour);

}
