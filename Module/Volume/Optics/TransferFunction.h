// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/ScalarNormalization.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus
{

/**
 * A control point. Two points at one scalar make a jump: the first holds below it, the second
 * above.
 */
struct TransferFunctionPoint
{
  double Scalar;
  /** Attenuation coefficient per unit length, >= 0. */
  double Attenuation;
  glm::dvec3 Color;
};

/** Linear piece of a transfer function between two of its points, in normalised scalars. */
struct TransferFunctionInterval
{
  float Lower;
  float Upper;
  float Attenuation;
  float AttenuationSlope;
  glm::vec3 Color;
  glm::vec3 ColorSlope;
};

/**
 * Intervals of a transfer function for float evaluation: piecewise linear attenuation and colour
 * between `points` (in the order of their scalars), constant outside of them. They cover every
 * finite normalised scalar, ascending and without gaps. Without any point, the result is one
 * interval of zero attenuation.
 */
std::vector<TransferFunctionInterval> BuildIntervals(
  const std::vector<TransferFunctionPoint>& points, const ScalarNormalization& normalization);

/**
 * Features of the function with these points: the scalars at which it changes, and the widths of
 * the changes.
 */
std::vector<ScalarFeature> FeaturesOf(const std::vector<TransferFunctionPoint>& points);

}
