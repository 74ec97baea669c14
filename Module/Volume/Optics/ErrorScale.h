// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Volume/Optics/TransferFunction.h"

#include <vector>

namespace meniscus
{

/**
 * Rising scale of a scalar: the distance of two scalars on it is the error that is made where one
 * is drawn instead of the other. Initially all distances are 0.
 */
class ErrorScale
{
public:
  /** A place on the scale. Two knots at one scalar make a jump. */
  struct Knot
  {
    double Scalar;
    double Error;
  };

  ErrorScale() = default;
  /** @param knots ascending; the scale is linear between them and constant outside of them. */
  explicit ErrorScale(std::vector<Knot> knots);
  /** Errors that are proportional to the difference; none if the unit is not positive. */
  static ErrorScale Proportional(double unit);

  /** Error of one scalar in place of another; 0 unless their difference is finite. */
  double Measure(double a, double b) const;
  /** Bound of the error of scalars from `lower` to `upper` that are off by up to `difference`. */
  double Bound(double lower, double upper, double difference) const;

private:
  double At(double scalar) const;

  std::vector<Knot> Knots;
  /** Error of a unit of a proportional scale. */
  double Slope = 0.0;
};

/** The use of scalars in a picture. */
enum class ScalarUse
{
  /** They are measured: an error is a fraction of their range. */
  Values,
  /** Colour and attenuation of a medium. */
  Medium,
  /** Colour and opacity of a single scalar per pixel, or of a sum of scalars. */
  Colors,
  /** Isovalues. */
  Surfaces
};

/** The function by which a picture shows scalars. */
struct PictureFunction
{
  ScalarUse Use = ScalarUse::Values;
  /** Points of the function, or one point per isovalue. */
  std::vector<TransferFunctionPoint> Points;
  /** Changes with the function. */
  TableVersion Version;

  /**
   * Scale of the errors that a picture shows, in units of its full colour. For a medium, with
   * attenuation a and colour c, its slope is
   *
   *     (|a'| + a |c'|) / (a + 1 / length).
   *
   * If it keeps an error e along a ray, the ray's colour is off by no more than e times the
   * integral of (a + 1 / length) times the transparency in front: that is below
   * e (1 - t + s / length), with the transparency t behind the ray and its length s in the medium.
   * So the error is relative in a dense medium, where the eye sees a short way, and absolute in a
   * thin one.
   * @param length size of the medium, in the unit of the attenuation.
   * @param range width of the scalars' range.
   */
  ErrorScale MakeScale(double length, double range) const;
};

}
