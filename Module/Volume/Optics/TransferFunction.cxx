// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/TransferFunction.h"

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

/** A value beyond all normalised scalars whose double is still a finite float. */
constexpr float Beyond = std::numeric_limits<float>::max() / 4.0f;

double Limited(double value)
{
  return std::min(std::max(value, -double{ Beyond }), double{ Beyond });
}

float ToFloat(double value)
{
  return static_cast<float>(Limited(value));
}

glm::vec3 ToFloat(const glm::dvec3& value)
{
  return { ToFloat(value.x), ToFloat(value.y), ToFloat(value.z) };
}

TransferFunctionInterval ConstantInterval(
  float lower, float upper, const TransferFunctionPoint& value)
{
  return { lower, upper, ToFloat(value.Attenuation), 0.0f, glm::vec3(value.Color),
    glm::vec3(0.0f) };
}

}

//------------------------------------------------------------------------------
std::vector<TransferFunctionInterval> BuildIntervals(
  const std::vector<TransferFunctionPoint>& points, const ScalarNormalization& normalization)
{
  std::vector<TransferFunctionInterval> intervals;
  if (points.empty())
  {
    intervals.push_back(ConstantInterval(-Beyond, Beyond, { 0.0, 0.0, glm::dvec3(0.0) }));
    return intervals;
  }
  const auto normalized = [&normalization](const TransferFunctionPoint& point)
  { return ToFloat(normalization(point.Scalar)); };

  intervals.reserve(points.size() + 1);
  intervals.push_back(ConstantInterval(-Beyond, normalized(points.front()), points.front()));
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    const TransferFunctionPoint& a = points[i];
    const TransferFunctionPoint& b = points[i + 1];
    TransferFunctionInterval interval = ConstantInterval(normalized(a), normalized(b), a);
    const double width = static_cast<double>(interval.Upper) - interval.Lower;
    if (width > 0.0)
    {
      // Between attenuations that are limited themselves, so that none in between is larger.
      interval.AttenuationSlope =
        ToFloat((Limited(b.Attenuation) - Limited(a.Attenuation)) / width);
      interval.ColorSlope = ToFloat((b.Color - a.Color) / width);
    }
    intervals.push_back(interval);
  }
  intervals.push_back(ConstantInterval(normalized(points.back()), Beyond, points.back()));
  return intervals;
}

//------------------------------------------------------------------------------
std::vector<ScalarFeature> FeaturesOf(const std::vector<TransferFunctionPoint>& points)
{
  std::vector<ScalarFeature> features;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    const TransferFunctionPoint& a = points[i];
    const TransferFunctionPoint& b = points[i + 1];
    if (a.Attenuation != b.Attenuation || a.Color != b.Color)
    {
      const double width = b.Scalar - a.Scalar;
      features.push_back({ a.Scalar, width });
      features.push_back({ b.Scalar, width });
    }
  }
  return features;
}

}
