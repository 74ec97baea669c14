// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/ScalarNormalization.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Largest = std::numeric_limits<double>::max();

/**
 * Size of the sample. A fraction of 1/64 is 16 of its elements, which is known to within a quarter.
 */
constexpr std::size_t SampleSize = 1024;
constexpr std::size_t SpacingShare = 64;

/**
 * Largest accepted cost. The rounding error of a normalised scalar is 2^-24 of its distance from
 * the offset. At a distance of this many widths of a change it is 1.5e-5 of the change, 1/500 of
 * the step between two of 255 levels.
 */
constexpr double LargestCost = 256.0;
/**
 * Improvement factor from which a new normalisation is accepted: it costs an upload of all scalars.
 */
constexpr double WorthwhileGain = 16.0;
/** Cost, in the same units, of a width that is lost by far scalars: no precision is left. */
constexpr double LostCost = 16777216.0;

/**
 * Largest ratio of the farthest scalar to the width of a change that single precision handles
 * without compression of far scalars: products with areas of 2^-44 (of cells and of the mesh) and
 * differences of 2^-16 of the width stay above 2^-126.
 */
constexpr double LargestRatio = 18446744073709551616.0; // 2^64
/** Ratio of the unit to the width beyond LargestRatio; NearEnd times this is 2^24. */
constexpr double UnitPerWidth = 1099511627776.0; // 2^40

double Distance(double a, double b)
{
  return std::min(std::abs(a - b), Largest);
}

/**
 * 1 / x, or 1 if x or that is not a positive number. The largest number for a denormal x: a range
 * of such scalars becomes a small part of [-1, 1], in which floats have as many digits.
 */
double ReciprocalOf(double x)
{
  const double reciprocal = x > 0.0 ? std::min(1.0 / x, Largest) : 0.0;
  return reciprocal > 0.0 ? reciprocal : 1.0;
}

std::vector<ScalarFeature> FeaturesInRange(
  const ScalarDistribution& scalars, const std::vector<ScalarFeature>& features)
{
  std::vector<ScalarFeature> inRange;
  for (const ScalarFeature& feature : features)
  {
    if (feature.Scalar >= scalars.GetLowest() && feature.Scalar <= scalars.GetHighest())
    {
      inRange.push_back(feature);
    }
  }
  return inRange;
}

/** Widens each feature to at least the spacing of the scalars there. */
void Resolve(const ScalarDistribution& scalars, std::vector<ScalarFeature>& features)
{
  for (ScalarFeature& feature : features)
  {
    feature.Width = std::max(feature.Width, scalars.SpacingAt(feature.Scalar));
  }
}

/**
 * Largest distance of a feature from the offset, in widths of the feature; larger if the feature is
 * lost.
 */
double CostOf(const ScalarNormalization& normalization, const std::vector<ScalarFeature>& features)
{
  const double nearEnd = normalization.Farthest > 1.0
    ? ScalarNormalization::NearEnd / normalization.Scale
    : std::numeric_limits<double>::infinity();
  double cost = 0.0;
  for (const ScalarFeature& feature : features)
  {
    const double distance = Distance(feature.Scalar, normalization.Offset);
    if (feature.Width > 0.0 && 1.0 / normalization.Scale > LargestRatio * feature.Width)
    {
      cost = std::max(cost, LostCost); // the feature is too small to be computed with, wherever it
                                       // is
    }
    if (distance > 0.0)
    {
      const double factor = distance > nearEnd ? LostCost : 1.0;
      cost = std::max(cost, factor * std::min(distance / feature.Width, Largest / LostCost));
    }
  }
  return cost;
}

/** Normalisation that maps the feature to zero. */
ScalarNormalization NormalizeAbout(const ScalarFeature& feature, const ScalarDistribution& scalars)
{
  ScalarNormalization result;
  result.Offset = feature.Scalar;
  result.GradientScale = ReciprocalOf(feature.Width);
  const double farthest = std::max(
    Distance(scalars.GetLowest(), feature.Scalar), Distance(scalars.GetHighest(), feature.Scalar));
  double unit = farthest;
  if (feature.Width > 0.0 && farthest > LargestRatio * feature.Width)
  {
    // All scalars but the farthest ones are near, whatever the width.
    const double nearest = scalars.LargestDistance(feature.Scalar, farthest / LargestRatio);
    unit = std::min(
      farthest, std::max(UnitPerWidth * feature.Width, nearest / ScalarNormalization::NearEnd));
  }
  result.Scale = ReciprocalOf(unit);
  result.Farthest = std::max(1.0, farthest * result.Scale);
  return result;
}

}

//------------------------------------------------------------------------------
double ScalarNormalization::operator()(double scalar) const
{
  const double away = scalar - this->Offset;
  // Halves where the difference exceeds the largest number.
  const double normalized = std::isinf(away) && std::isfinite(scalar)
    ? (0.5 * scalar - 0.5 * this->Offset) * this->Scale * 2.0
    : away * this->Scale;
  const double size = std::abs(normalized);
  if (!(this->Farthest > 1.0) || !(size > NearEnd))
  {
    return normalized;
  }
  return std::copysign(std::max(NearEnd, size / this->Farthest), normalized);
}

//------------------------------------------------------------------------------
ScalarNormalization NormalizeRange(double minimum, double maximum)
{
  const double middle = 0.5 * minimum + 0.5 * maximum;
  // In a range of few floating-point numbers, the rounded middle is not as far from both ends.
  const double half =
    std::max(0.5 * maximum - 0.5 * minimum, std::max(maximum - middle, middle - minimum));
  const double scale = ReciprocalOf(half);
  return { middle, scale, 1.0, scale };
}

//------------------------------------------------------------------------------
ScalarDistribution::ScalarDistribution(
  double lowest, double highest, const std::vector<double>& scalars)
  : Lowest(lowest)
  , Highest(highest)
{
  const std::size_t size = std::min(scalars.size(), SampleSize);
  for (std::size_t i = 0; i < size; ++i)
  {
    const double scalar = scalars[i * scalars.size() / size];
    if (std::isfinite(scalar))
    {
      this->Sample.push_back(scalar);
    }
  }
  std::sort(this->Sample.begin(), this->Sample.end());
}

//------------------------------------------------------------------------------
double ScalarDistribution::SpacingAt(double scalar) const
{
  const auto equal = std::equal_range(this->Sample.begin(), this->Sample.end(), scalar);
  auto below = equal.first;
  auto above = equal.second;
  const auto others = this->Sample.size() - static_cast<std::size_t>(std::distance(below, above));
  double spacing = 0.0;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, others / SpacingShare) && i < others; ++i)
  {
    const bool takeBelow = above == this->Sample.end() ||
      (below != this->Sample.begin() && Distance(scalar, *(below - 1)) <= Distance(*above, scalar));
    spacing = Distance(takeBelow ? *--below : *above++, scalar);
  }
  return spacing;
}

//------------------------------------------------------------------------------
double ScalarDistribution::LargestDistance(double from, double limit) const
{
  double largest = 0.0;
  for (const double scalar : this->Sample)
  {
    const double distance = Distance(scalar, from);
    largest = distance <= limit ? std::max(largest, distance) : largest;
  }
  return largest;
}

//------------------------------------------------------------------------------
ScalarNormalization ChooseNormalization(const ScalarDistribution& scalars,
  const std::vector<ScalarFeature>& features, const ScalarNormalization* current)
{
  if (scalars.IsEmpty())
  {
    return ScalarNormalization();
  }
  const ScalarNormalization ofRange = NormalizeRange(scalars.GetLowest(), scalars.GetHighest());
  const ScalarNormalization& first = current ? *current : ofRange;
  std::vector<ScalarFeature> resolved = FeaturesInRange(scalars, features);
  if (CostOf(first, resolved) <= LargestCost)
  {
    return first;
  }
  Resolve(scalars, resolved);
  if (CostOf(first, resolved) <= LargestCost)
  {
    return first;
  }
  const double costOfRange = CostOf(ofRange, resolved);
  if (costOfRange <= LargestCost)
  {
    return ofRange;
  }
  // The best cost bounds the distance of the best offset from the narrowest feature, in widths of
  // that feature, which are the smallest. So an offset at the narrowest feature costs at most twice
  // as much.
  const ScalarFeature narrowest = *std::min_element(resolved.begin(), resolved.end(),
    [](const ScalarFeature& a, const ScalarFeature& b) { return a.Width < b.Width; });
  const ScalarNormalization aboutFeature = NormalizeAbout(narrowest, scalars);
  const double costAbout = CostOf(aboutFeature, resolved);
  const bool worthwhile = costOfRange > WorthwhileGain * costAbout;
  const double cost = worthwhile ? costAbout : costOfRange;
  if (current && CostOf(*current, resolved) <= WorthwhileGain * cost)
  {
    return *current;
  }
  return worthwhile ? aboutFeature : ofRange;
}

//------------------------------------------------------------------------------
ScalarRange SampledRange(const ScalarDistribution& scalars,
  const std::vector<ScalarFeature>& features, const ScalarNormalization& normalization)
{
  constexpr double smallestShare = 1.0 / 64.0;
  const double low = scalars.GetLowest();
  const double high = scalars.GetHighest();
  double first = low;
  double last = high;
  if (!features.empty())
  {
    const auto range = std::minmax_element(features.begin(), features.end(),
      [](const ScalarFeature& a, const ScalarFeature& b) { return a.Scalar < b.Scalar; });
    first = std::clamp(range.first->Scalar, low, high);
    last = std::clamp(range.second->Scalar, low, high);
  }
  if (first == last)
  {
    const double spacing = scalars.SpacingAt(first);
    first -= spacing;
    last += spacing;
  }
  if (0.5 * last - 0.5 * first >= smallestShare * (0.5 * high - 0.5 * low))
  {
    first = low;
    last = high;
  }
  const ScalarRange range{ normalization(first), normalization(last) };
  return range.Lowest < range.Highest ? range : ScalarRange();
}

}
