// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Normalised scalars: the single-precision numbers that rays interpolate instead of the user's
 * scalars.
 *
 * Floats have the highest absolute precision near zero, so the scalar that is mapped to zero
 * decides where precision is spent. Normally this is the middle of the data's range. Where a
 * transfer function changes over so small a part of the range that rounding would be visible (for
 * example with a fill value of 1e20 among scalars around 300), it is a scalar at which the function
 * changes fastest.
 */
#pragma once

#include "Common/TableVersion.h"

#include <cstddef>
#include <vector>

namespace meniscus
{

/** Maps scalars to [-1, 1], ascending: (scalar - Offset) * Scale, except for far scalars. */
struct ScalarNormalization
{
  double Offset = 0.0;
  double Scale = 1.0;
  /**
   * Largest distance of a normalised scalar from the offset. It exceeds 1 if the range of double is
   * too large for the products that rays form in single precision. In that case normalised scalars
   * beyond NearEnd are divided by it, but not to below NearEnd.
   */
  double Farthest = 1.0;
  /** Unit of gradients: scalars times this factor, per length. */
  double GradientScale = 1.0;

  /**
   * Limit up to which Farthest does not change scalars. It is at least 2^24 times the width of the
   * function's changes at the offset: in a cell between such a scalar and a far one, these changes
   * take a smaller part of the cell's length than its rounding error. Far scalars keep their
   * proportions to 2^-16 of the farthest.
   */
  static constexpr double NearEnd = 1.0 / 65536.0;

  double operator()(double scalar) const;

  bool operator==(const ScalarNormalization& other) const
  {
    return this->Offset == other.Offset && this->Scale == other.Scale &&
      this->Farthest == other.Farthest && this->GradientScale == other.GradientScale;
  }
  bool operator!=(const ScalarNormalization& other) const { return !(*this == other); }
};

/** Normalisation that maps a range to [-1, 1]. */
ScalarNormalization NormalizeRange(double minimum, double maximum);

/** A range of normalised scalars that a blend mode maps to 0 and 1. */
struct ScalarRange
{
  double Lowest = -1.0;
  double Highest = 1.0;
};

inline bool operator==(const ScalarRange& a, const ScalarRange& b)
{
  return a.Lowest == b.Lowest && a.Highest == b.Highest;
}

/** Range of the finite scalars, and their distribution in it. */
class ScalarDistribution
{
public:
  ScalarDistribution() = default;
  /** @param scalars all scalars; those that are not finite are ignored. */
  ScalarDistribution(double lowest, double highest, const std::vector<double>& scalars);

  bool IsEmpty() const { return this->Sample.empty(); }
  double GetLowest() const { return this->Lowest; }
  double GetHighest() const { return this->Highest; }

  /**
   * Distance from a scalar within which 1/64 of the other scalars lie, at least one; 0 if there is
   * none. A fraction is used because fill values may make up nearly all of the data without
   * affecting it near the rest.
   */
  double SpacingAt(double scalar) const;
  /** Largest distance of a scalar from `from` that is not above `limit`; 0 if there is none. */
  double LargestDistance(double from, double limit) const;

private:
  /** Ascending, taken evenly from all scalars. */
  std::vector<double> Sample;
  double Lowest = 0.0;
  double Highest = 0.0;
};

/** A scalar at which a function changes, and the width of the change; 0 for a jump. */
struct ScalarFeature
{
  double Scalar;
  double Width;
};

/** Features of the function of each scalar: the main one first, then the other components. */
struct FunctionFeatures
{
  std::vector<std::vector<ScalarFeature>> OfScalars;
  /** Changes with the features. */
  TableVersion Version;

  const std::vector<ScalarFeature>& Of(std::size_t scalar) const
  {
    static const std::vector<ScalarFeature> none;
    return scalar < this->OfScalars.size() ? this->OfScalars[scalar] : none;
  }
};

/**
 * Normalisation of scalars for a function with these features. Keeps `current` as long as it is
 * good enough; `current` is null or was made for the same scalars.
 */
ScalarNormalization ChooseNormalization(const ScalarDistribution& scalars,
  const std::vector<ScalarFeature>& features, const ScalarNormalization* current);

/**
 * Range of normalised scalars for a table of samples: the range of the data or, if that is less
 * than 1/64 of it, the part that contains all features.
 */
ScalarRange SampledRange(const ScalarDistribution& scalars,
  const std::vector<ScalarFeature>& features, const ScalarNormalization& normalization);

}
