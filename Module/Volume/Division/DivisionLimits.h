// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Division/ShapeFunctions.h"
#include "Volume/Optics/ErrorScale.h"

#include <array>
#include <cstdint>
#include <limits>

namespace meniscus
{

/** Conversion of displacements and differences of values to errors, in the unit of a tolerance. */
struct DivisionMeasure
{
  /** Error of a displacement by one unit of length. */
  double OfPlace = 0.0;
  /** Displacements up to this length are due to rounding; they are no errors. */
  double PlaceRounding = 0.0;
  std::array<ErrorScale, CellSample::MostFields> OfValues;
  /** Differences up to these are due to rounding; they are no errors. */
  std::array<double, CellSample::MostFields> ValueRounding{};
  /**
   * True if a value that is drawn nearby counts as displaced, where that is the smaller error: so a
   * jump of the function that shows the values has an error of its place only.
   */
  bool ValuesMayMove = false;
  /**
   * True if values are seen as isosurfaces: a place of an edge has an error if the difference there
   * moves a surface that meets the edge anywhere. At the place itself, it is mostly not seen.
   */
  bool HasSurfaces = false;
};

/** Accuracy and size of a division. */
struct DivisionLimits
{
  DivisionMeasure Measure;
  /** Edges with larger errors are divided. */
  double Tolerance = 1.0;
  /**
   * Number of divisions, at most, that lead to a point. 23 are the most for which reference
   * coordinates are exact in single precision.
   */
  int MostLevels = 23;
  /** Budget of pieces. It is spent where errors are largest. */
  std::int64_t MostPieces = std::numeric_limits<std::int32_t>::max();
};

}
