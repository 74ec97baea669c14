// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/ErrorScale.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

/** Largest difference of a channel. */
double Difference(const glm::dvec3& a, const glm::dvec3& b)
{
  const glm::dvec3 d = glm::abs(a - b);
  return std::max({ d.x, d.y, d.z });
}

/** 1 + the optical depth of a length, within the finite numbers. */
double DepthOf(const TransferFunctionPoint& point, double length)
{
  const double depth = length * point.Attenuation;
  return depth > 0.0 ? std::min(1.0 + depth, std::numeric_limits<double>::max()) : 1.0;
}

/**
 * Appends knots for a linear piece of a medium's function. With u = 1 + length a, the slope's
 * integral is log(u) and, for the colour, that of (u - 1) / u. The knots divide u in equal ratios
 * of 1.5 at most, within which the slope of log(u) varies by no more than that.
 */
void AddMedium(const TransferFunctionPoint& from, const TransferFunctionPoint& to, double length,
  std::vector<ErrorScale::Knot>& knots)
{
  const double first = DepthOf(from, length);
  const double last = DepthOf(to, length);
  const double color = Difference(from.Color, to.Color);
  constexpr double ratio = 1.5;
  const double change = std::abs(std::log(last / first));
  const int parts = 1 + static_cast<int>(change / std::log(ratio));
  double error = knots.back().Error;
  double lower = first;
  for (int i = 1; i <= parts; ++i)
  {
    const double upper = i == parts ? last : first * std::pow(last / first, double(i) / parts);
    const double share = last != first ? (upper - first) / (last - first) : 1.0;
    const double step = last != first ? (upper - lower) / (last - first) : 1.0;
    const double middle = 0.5 * (lower + upper);
    error += std::abs(std::log(upper / lower)) + color * step * (middle - 1.0) / middle;
    knots.push_back({ from.Scalar + share * (to.Scalar - from.Scalar), error });
    lower = upper;
  }
}

/** Appends a knot for a linear piece of a function whose opacities are not accumulated. */
void AddColors(const TransferFunctionPoint& from, const TransferFunctionPoint& to,
  std::vector<ErrorScale::Knot>& knots)
{
  const double first = std::clamp(from.Attenuation, 0.0, 1.0);
  const double last = std::clamp(to.Attenuation, 0.0, 1.0);
  knots.push_back({ to.Scalar,
    knots.back().Error + std::abs(last - first) +
      std::max(first, last) * Difference(from.Color, to.Color) });
}

}

//------------------------------------------------------------------------------
ErrorScale::ErrorScale(std::vector<Knot> knots)
  : Knots(std::move(knots))
{
}

//------------------------------------------------------------------------------
ErrorScale ErrorScale::Proportional(double unit)
{
  ErrorScale scale;
  scale.Slope = unit > 0.0 ? 1.0 / unit : 0.0;
  return scale;
}

//------------------------------------------------------------------------------
double ErrorScale::At(double scalar) const
{
  const auto above = std::upper_bound(this->Knots.begin(), this->Knots.end(), scalar,
    [](double value, const Knot& knot) { return value < knot.Scalar; });
  if (above == this->Knots.begin())
  {
    return above->Error;
  }
  const Knot& lower = *std::prev(above);
  if (above == this->Knots.end())
  {
    return lower.Error;
  }
  const double share = (scalar - lower.Scalar) / (above->Scalar - lower.Scalar);
  return lower.Error + share * (above->Error - lower.Error);
}

//------------------------------------------------------------------------------
double ErrorScale::Measure(double a, double b) const
{
  const double difference = std::abs(a - b);
  if (!std::isfinite(difference))
  {
    return 0.0;
  }
  return this->Knots.empty() ? this->Slope * difference : std::abs(this->At(a) - this->At(b));
}

//------------------------------------------------------------------------------
double ErrorScale::Bound(double lower, double upper, double difference) const
{
  if (this->Knots.empty())
  {
    return this->Slope * difference;
  }
  const double first = lower - difference;
  const double last = upper + difference;
  double slope = 0.0;
  auto knot = std::upper_bound(this->Knots.begin(), this->Knots.end(), first,
    [](double value, const Knot& other) { return value < other.Scalar; });
  for (knot = knot == this->Knots.begin() ? std::next(knot) : knot;
       knot != this->Knots.end() && std::prev(knot)->Scalar <= last; ++knot)
  {
    const Knot& before = *std::prev(knot);
    if (knot->Error > before.Error)
    {
      // Infinite at a jump.
      slope = std::max(slope, (knot->Error - before.Error) / (knot->Scalar - before.Scalar));
    }
  }
  return std::min(slope * difference, this->At(last) - this->At(first));
}

//------------------------------------------------------------------------------
ErrorScale PictureFunction::MakeScale(double length, double range) const
{
  if (this->Use == ScalarUse::Values)
  {
    return ErrorScale::Proportional(range);
  }
  if (this->Points.empty())
  {
    return ErrorScale();
  }
  std::vector<TransferFunctionPoint> points = this->Points;
  std::stable_sort(points.begin(), points.end(),
    [](const TransferFunctionPoint& a, const TransferFunctionPoint& b)
    { return a.Scalar < b.Scalar; });
  std::vector<ErrorScale::Knot> knots{ { points.front().Scalar, 0.0 } };
  for (std::size_t i = this->Use == ScalarUse::Surfaces ? 0 : 1; i < points.size(); ++i)
  {
    if (this->Use == ScalarUse::Surfaces)
    {
      // The surface is seen on one side of the isovalue and not on the other.
      const double before = knots.back().Error;
      knots.push_back({ points[i].Scalar, before });
      knots.push_back({ points[i].Scalar, before + std::clamp(points[i].Attenuation, 0.0, 1.0) });
    }
    else if (this->Use == ScalarUse::Medium)
    {
      AddMedium(points[i - 1], points[i], length, knots);
    }
    else
    {
      AddColors(points[i - 1], points[i], knots);
    }
  }
  return ErrorScale(std::move(knots));
}

}
