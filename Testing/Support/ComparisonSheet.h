// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Square pictures in rows and columns with titles: drawn by the project, made by a reference, and
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
  /**
   * A white sheet with a title, which may be empty, for each row and each column. Each picture has
   * `side` x `side` pixels and a frame.
   */
  ComparisonSheet(
    const std::vector<std::string>& rows, const std::vector<std::string>& columns, int side);

  int GetSide() const { return this->Side; }

  /**
   * Rows are counted downwards, y upwards within a picture. Colours are clamped to 0 and 1 and
   * rounded to multiples of 1 / 51.
   */
  void SetPixel(int row, int column, int x, int y, const glm::dvec3& colour);

  /** Writes the title of a column that has none yet. */
  void SetColumnTitle(int column, const std::string& title);

  void Write(const std::string& path) const;

private:
  static constexpr int Gap = 6;     // pixels between pictures
  static constexpr int Margin = 26; // pixels for the titles, above and on the left

  /** Pixel of the sheet at the lower left corner of a picture. */
  int GetLeft(int column) const { return Margin + column * (this->Side + Gap); }
  int GetBottom(int row) const { return Gap + (this->Rows - 1 - row) * (this->Side + Gap); }
  unsigned char* GetPixel(int x, int y);
  void DrawFrame(int row, int column);
  /** Draws a line of text centred about a point, upwards or to the right. */
  void DrawText(const std::string& text, int x, int y, bool upwards);

  int Rows;
  int Side;
  vtkSmartPointer<vtkImageData> Image;
};

/** Colour of a place on an object. */
using PlaceColour = std::function<glm::dvec3(const glm::dvec3& place)>;

/** Colour of a pixel; a light grey where there is no object. */
glm::dvec3 GetColour(const PlacePixel& pixel, const PlaceColour& colour);

/** A sheet with a column for each scene, to be filled by AddComparison(). */
ComparisonSheet MakeSceneSheet(std::size_t scenes, int side);

/**
 * Fills a column, from the top, with the places that are drawn, those that are traced, and their
 * difference: white for equal places, black from half a pixel on (these pixels count), red where
 * only one of the two pictures shows the object. Prints and returns the comparison. The side of the
 * pictures must be a multiple of that of the sheet; the difference shows the largest one of several
 * pixels.
 */
PlaceComparison AddComparison(ComparisonSheet& sheet, int column, const std::string& name,
  const PixelCamera& camera, const PlacePicture& drawn, const PlacePicture& traced,
  const PlaceColour& colour);

}
