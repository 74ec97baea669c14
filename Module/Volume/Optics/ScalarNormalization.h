// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Normalised scalars: the single-precision numbers that rays interpolate in place of the user's.
 *
 * A float is as precise as it is near zero, so the scalar that becomes zero decides where precision
 * is spent. As a rule that is the middle of the data's range. Where a transfer function changes
 * over so small a part of the range that rounding would show (a fill value such as 1e20 among
 * scalars around 300), it is a scalar where the function changes fastest.
 */
#ifndef meniscus_Volume_Optics_ScalarNormalization_h
#define meniscus_Volume_Optics_ScalarNormalization_h

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
   * Largest distance of a scalar from the offset, normalised; more than 1 if the range of double is
   * too much for the products that rays form in single precision. Then normalised scalars beyond
   * NearEnd are divided by it, but not to below NearEnd.
   */
  double Farthest = 1.0;
  /** Unit of gradients: scalars times this, per length. */
  double GradientScale = 1.0;

  /**
   * Scalars up to here are not changed by Farthest. It is 2^24 times the width of the function's
   * changes at the offset, or more: in a cell from there to a far scalar, these changes take less
   * than rounding of the cell's length either way. Far scalars keep their proportion to 2^-16 of
   * the farthest.
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

/** Maps a range to [-1, 1]. */
ScalarNormalization NormalizeRange(double minimum, double maximum);

/** A range of normalised scalars: what is seen as 0 and as 1 where a mode shows a share of it. */
struct ScalarRange
{
  double Lowest = -1.0;
  double Highest = 1.0;
};

/** Range of finite scalars, and how they are distributed in it. */
class ScalarDistribution
{
public:
  ScalarDistribution() = default;
  /** @param scalars  those that are not finite do not count. */
  ScalarDistribution(double lowest, double highest, const std::vector<double>& scalars);

  bool IsEmpty() const { return this->Sample.empty(); }
  double GetLowest() const { return this->Lowest; }
  double GetHighest() const { return this->Highest; }

  /**
   * Distance from a scalar within which 1/64 of the other scalars lie, at least one; 0 without.
   * Fill values may take nearly all of the data without changing it near the rest.
   */
  double SpacingAt(double scalar) const;
  /** Largest distance from a scalar that is not above a limit; 0 without. */
  double LargestDistance(double from, double limit) const;

private:
  /** Ascending, evenly taken from all. */
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

/** The features of a function per scalar that it has: the main one, then other components. */
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
 * The normalisation of scalars for a function with these features. Keeps `current`, if it is not
 * null and was made for the same scalars, as long as it serves.
 */
ScalarNormalization ChooseNormalization(const ScalarDistribution& scalars,
  const std::vector<ScalarFeature>& features, const ScalarNormalization* current);

/**
 * Normalised scalars for a table of samples: the range of the data, or the part of it that all
 * features are in if that is less than 1/64.
 */
ScalarRange SampledRange(const ScalarDistribution& scalars,
  const std::vector<ScalarFeature>& features, const ScalarNormalization& normalization);

}

#endif
