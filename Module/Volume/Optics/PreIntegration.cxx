// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/PreIntegration.h"

#include "Common/BlockLoop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Largest optical depth d of a segment whose absorption of its own emission is neglected: for
 * linear colour from 0 to 1 and constant attenuation the colour's error is d^2 / 12, here 2e-5.
 */
constexpr double ShallowDepth = 1.0 / 64.0;
/** Optical depth of the first length above 0, if there are enough lengths. */
constexpr double FirstDepth = 1.0 / 16.0;
/** Optical depth of the segments from which the doubling starts: its error is d^2 / 12 = 8e-8. */
constexpr double SeedDepth = 1.0 / 1024.0;
/** Limit that keeps products with lengths finite. */
constexpr double LargestDepth = 1.0e+30;

double AttenuationAt(const TransferFunctionInterval& interval, double scalar)
{
  const double offset = scalar - interval.Lower;
  return std::max(0.0, interval.Attenuation + offset * interval.AttenuationSlope);
}

glm::dvec3 ColorAt(const TransferFunctionInterval& interval, double scalar)
{
  return glm::dvec3(interval.Color) + (scalar - interval.Lower) * glm::dvec3(interval.ColorSlope);
}

/** Opacity of a segment with constant or mean attenuation. */
double Opacity(double attenuation, double length)
{
  return -std::expm1(-std::min(attenuation * length, LargestDepth));
}

/** The same function with (scalar - middle) * perHalfRange as its argument. */
std::vector<TransferFunctionInterval> Moved(
  std::vector<TransferFunctionInterval> intervals, double middle, double perHalfRange)
{
  for (TransferFunctionInterval& interval : intervals)
  {
    const auto move = [=](float scalar)
    {
      constexpr double beyond = std::numeric_limits<float>::max();
      return static_cast<float>(std::clamp((scalar - middle) * perHalfRange, -beyond, beyond));
    };
    const double width = static_cast<double>(interval.Upper) - interval.Lower;
    interval.Lower = move(interval.Lower);
    interval.Upper = move(interval.Upper);
    // The new ends are rounded, so the slopes follow the new width: the values at the ends stay.
    const double newWidth = static_cast<double>(interval.Upper) - interval.Lower;
    const double perWidth = newWidth > 0.0 ? width / newWidth : 0.0;
    interval.AttenuationSlope = static_cast<float>(interval.AttenuationSlope * perWidth);
    interval.ColorSlope = glm::vec3(glm::dvec3(interval.ColorSlope) * perWidth);
  }
  return intervals;
}

/** True if all visible scalars in [-1, 1] have the same colour. */
bool HasOneColor(const std::vector<TransferFunctionInterval>& intervals)
{
  const TransferFunctionInterval* first = nullptr;
  for (const TransferFunctionInterval& interval : intervals)
  {
    const bool seen = interval.Lower <= 1.0f && interval.Upper >= -1.0f &&
      (interval.Attenuation > 0.0f || interval.AttenuationSlope > 0.0f);
    if (!seen)
    {
      continue;
    }
    first = first ? first : &interval;
    if (interval.ColorSlope != glm::vec3(0.0f) || interval.Color != first->Color)
    {
      return false;
    }
  }
  return true;
}

double LargestAttenuationOf(const std::vector<TransferFunctionInterval>& intervals)
{
  double largest = 0.0;
  for (const TransferFunctionInterval& interval : intervals)
  {
    const double lower = std::max(-1.0, static_cast<double>(interval.Lower));
    const double upper = std::min(1.0, static_cast<double>(interval.Upper));
    if (lower <= upper)
    {
      largest =
        std::max({ largest, AttenuationAt(interval, lower), AttenuationAt(interval, upper) });
    }
  }
  return largest;
}

}

//------------------------------------------------------------------------------
double PreIntegrationTable::GetLength(int k) const
{
  return k == 0 ? 0.0
                : this->Shortest * std::exp2((k - 1) / static_cast<double>(this->LengthsPerOctave));
}

//------------------------------------------------------------------------------
void PreIntegrationTable::SampleFunction(const std::vector<TransferFunctionInterval>& intervals)
{
  const int count = 2 * this->Scalars - 1;
  const auto scalarOf = [count](int i) { return -1.0 + 2.0 * i / (count - 1); };
  this->Samples.assign(count, Sample());
  double depth = 0.0;
  std::size_t at = 0;
  double from = scalarOf(0);
  for (int i = 0; i < count; ++i)
  {
    const double to = scalarOf(i);
    Sample& sample = this->Samples[i];
    // Within an interval attenuation is linear and its product with colour quadratic, so Simpson's
    // rule is exact. The same weights for both make colours a mean, also where attenuation is cut
    // off at 0 by its rounding error.
    const auto add = [&](double end)
    {
      const TransferFunctionInterval& interval = intervals[at];
      const double sixth = (end - from) / 6.0;
      const auto addAt = [&](double scalar, double weight)
      {
        const double part = weight * AttenuationAt(interval, scalar);
        sample.StepDepth += part;
        sample.StepEmission += part * ColorAt(interval, scalar);
      };
      addAt(from, sixth);
      addAt(0.5 * (from + end), 4.0 * sixth);
      addAt(end, sixth);
      from = end;
    };
    while (at + 1 < intervals.size() && intervals[at].Upper < to)
    {
      if (intervals[at].Upper > from)
      {
        add(intervals[at].Upper);
      }
      ++at;
    }
    add(to);
    depth += sample.StepDepth;
    sample.Depth = depth;
    sample.Attenuation = AttenuationAt(intervals[at], to);
    sample.Color = ColorAt(intervals[at], to);
  }
}

//------------------------------------------------------------------------------
void PreIntegrationTable::ChooseLengths(
  const std::vector<TransferFunctionInterval>& intervals, double longest, int lengths)
{
  this->Longest = longest;
  this->Shortest = longest;
  this->LengthsPerOctave = 1;
  this->LargestAttenuation = LargestAttenuationOf(intervals);
  const double deepest = this->LargestAttenuation * longest;
  this->Lengths = deepest <= ShallowDepth || HasOneColor(intervals) ? 1 : lengths;
  if (this->Lengths > 2)
  {
    const int steps = this->Lengths - 2;
    const double octaves = std::max(1.0, std::ceil(std::log2(deepest / FirstDepth)));
    this->LengthsPerOctave = std::max(1, static_cast<int>(steps / octaves));
    this->Shortest = longest * std::exp2(-steps / static_cast<double>(this->LengthsPerOctave));
  }
}

//------------------------------------------------------------------------------
double PreIntegrationTable::MeanAttenuation(int front, int back) const
{
  const Sample& a = this->Samples[front];
  const Sample& b = this->Samples[back];
  const double perSample = 2.0 / static_cast<double>(this->Samples.size() - 1);
  return front == back ? a.Attenuation
                       : std::max(0.0, (b.Depth - a.Depth) / ((back - front) * perSample));
}

//------------------------------------------------------------------------------
PreIntegrationTable::Slice PreIntegrationTable::ShortSegments(const RangeLoop& loop) const
{
  const int count = this->Scalars;
  Slice slice(static_cast<std::size_t>(count) * count);
  const auto at = [count](int front, int back)
  { return static_cast<std::size_t>(back) * count + front; };
  ForEachItem(static_cast<std::size_t>(count), loop,
    [&](std::size_t row)
    {
      const int low = static_cast<int>(row);
      slice[at(low, low)] = glm::vec3(this->Samples[2 * low].Color);
      // Each segment is integrated by itself. Where the attenuation is small compared with other
      // places, the difference of two running integrals would consist of rounding errors.
      double depth = 0.0;
      glm::dvec3 emission(0.0);
      for (int high = low + 1; high < count; ++high)
      {
        for (int i = 2 * high - 1; i <= 2 * high; ++i)
        {
          depth += this->Samples[i].StepDepth;
          emission += this->Samples[i].StepEmission;
        }
        // Entries without opacity also need a colour, for interpolation: the colour in the
        // middle.
        slice[at(low, high)] =
          glm::vec3(depth > 0.0 ? emission / depth : this->Samples[low + high].Color);
        slice[at(high, low)] = slice[at(low, high)];
      }
    });
  return slice;
}

//------------------------------------------------------------------------------
PreIntegrationTable::Slice PreIntegrationTable::DoubleLength(
  const Slice& halves, double length, const RangeLoop& loop) const
{
  const int count = this->Scalars;
  const auto at = [&halves, count](int f, int b)
  { return halves[static_cast<std::size_t>(b) * count + f]; };
  Slice slice(halves.size());
  ForEachItem(static_cast<std::size_t>(count), loop,
    [&](std::size_t row)
    {
      const int b = static_cast<int>(row);
      for (int f = 0; f < count; ++f)
      {
        const int middle = f + b; // index among the samples, of which there are two per scalar
        const int below = middle / 2;
        const int above = below + middle % 2;
        const double front = Opacity(this->MeanAttenuation(2 * f, middle), 0.5 * length);
        const double back =
          (1.0 - front) * Opacity(this->MeanAttenuation(middle, 2 * b), 0.5 * length);
        const glm::vec3 frontColor = 0.5f * (at(f, below) + at(f, above));
        const glm::vec3 backColor = 0.5f * (at(below, b) + at(above, b));
        const double whole = front + back;
        const float share = whole > 0.0 ? static_cast<float>(front / whole) : 0.5f;
        slice[static_cast<std::size_t>(b) * count + f] =
          share * frontColor + (1.0f - share) * backColor;
      }
    });
  return slice;
}

//------------------------------------------------------------------------------
void PreIntegrationTable::Store(int length, const Slice& slice, const RangeLoop& loop)
{
  const int count = this->Scalars;
  float* values = &this->Values[4 * static_cast<std::size_t>(length) * slice.size()];
  ForEachItem(static_cast<std::size_t>(count), loop,
    [&](std::size_t row)
    {
      const int b = static_cast<int>(row);
      for (int f = 0; f < count; ++f)
      {
        const std::size_t i = static_cast<std::size_t>(b) * count + f;
        values[4 * i] = slice[i].r;
        values[4 * i + 1] = slice[i].g;
        values[4 * i + 2] = slice[i].b;
        values[4 * i + 3] = static_cast<float>(this->MeanAttenuation(2 * f, 2 * b));
      }
    });
}

//------------------------------------------------------------------------------
void PreIntegrationTable::Build(const std::vector<TransferFunctionInterval>& function,
  double longest, int scalars, int lengths, const RangeLoop& loop, const ScalarRange& range)
{
  this->Middle = 0.5 * (range.Lowest + range.Highest);
  this->PerHalfRange = 2.0 / (range.Highest - range.Lowest);
  const std::vector<TransferFunctionInterval> intervals =
    Moved(function, this->Middle, this->PerHalfRange);
  this->Scalars = scalars;
  this->ChooseLengths(intervals, longest, lengths);
  this->SampleFunction(intervals);
  const Slice seed = this->ShortSegments(loop);
  this->Values.assign(4 * static_cast<std::size_t>(this->Lengths) * seed.size(), 0.0f);
  this->Store(0, seed, loop);
  const int chains = std::min(this->LengthsPerOctave, this->Lengths - 1);
  for (int chain = 1; chain <= chains; ++chain)
  {
    const double first = this->GetLength(chain);
    const double depth = std::min(this->LargestAttenuation * first, LargestDepth);
    const int doublings =
      depth > SeedDepth ? static_cast<int>(std::ceil(std::log2(depth / SeedDepth))) : 0;
    Slice slice = seed;
    for (int i = 1; i <= doublings; ++i)
    {
      slice = this->DoubleLength(slice, std::ldexp(first, i - doublings), loop);
    }
    this->Store(chain, slice, loop);
    for (int k = chain + this->LengthsPerOctave; k < this->Lengths; k += this->LengthsPerOctave)
    {
      slice = this->DoubleLength(slice, this->GetLength(k), loop);
      this->Store(k, slice, loop);
    }
  }
}

}
