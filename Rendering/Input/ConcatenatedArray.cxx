// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/ConcatenatedArray.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace meniscus
{
namespace
{

/**
 * Length of a tuple, computed without overflow. A single component is returned with its sign, as
 * VTK's colour maps use it.
 */
double LengthOf(vtkDataArray* array, vtkIdType tuple)
{
  if (array->GetNumberOfComponents() == 1)
  {
    return array->GetComponent(tuple, 0);
  }
  double length = 0.0;
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    length = std::hypot(length, array->GetComponent(tuple, component));
  }
  return length;
}

/** Range of the finite values, and the number of values that are not finite. */
struct ValueRange
{
  double Lowest = std::numeric_limits<double>::infinity();
  double Highest = -std::numeric_limits<double>::infinity();
  std::int64_t NotFinite = 0;

  void Add(double value)
  {
    if (std::isfinite(value))
    {
      this->Lowest = std::min(this->Lowest, value);
      this->Highest = std::max(this->Highest, value);
    }
    else
    {
      ++this->NotFinite;
    }
  }
  void Add(const ValueRange& other)
  {
    this->Lowest = std::min(this->Lowest, other.Lowest);
    this->Highest = std::max(this->Highest, other.Highest);
    this->NotFinite += other.NotFinite;
  }
};

}

//------------------------------------------------------------------------------
ConcatenatedArray::ConcatenatedArray(
  const InputBlocks& input, int component, const WeightedPoints* points)
  : Input(input)
  , Component(component == ScalarSelection::Only ? 0 : component)
  , Points(points)
{
  std::int64_t next = 0;
  for (const InputPart& part : input.Parts)
  {
    this->Firsts.push_back(next);
    next += part.Scalars->GetNumberOfTuples();
  }
}

//------------------------------------------------------------------------------
ConcatenatedArray::Tuple ConcatenatedArray::Find(std::int32_t number) const
{
  const auto after = std::upper_bound(this->Firsts.begin() + 1, this->Firsts.end(), number);
  const auto part = static_cast<std::size_t>(after - this->Firsts.begin()) - 1;
  return { this->Input.Parts[part].Scalars, static_cast<vtkIdType>(number - this->Firsts[part]) };
}

//------------------------------------------------------------------------------
double ConcatenatedArray::ValueOf(std::int32_t number) const
{
  const Tuple tuple = this->Find(number);
  return this->Component == ScalarSelection::Magnitude
    ? LengthOf(tuple.Array, tuple.Number)
    : tuple.Array->GetComponent(
        tuple.Number, tuple.Array->GetNumberOfComponents() == 1 ? 0 : this->Component);
}

//------------------------------------------------------------------------------
double ConcatenatedArray::GetComponent(std::int32_t number, int component) const
{
  const Tuple tuple = this->Find(number);
  return component < tuple.Array->GetNumberOfComponents()
    ? tuple.Array->GetComponent(tuple.Number, component)
    : 0.0;
}

//------------------------------------------------------------------------------
/** Length of the interpolated tuple, which is not the interpolated length. */
double ConcatenatedArray::InterpolatedLength(std::int32_t number) const
{
  // A row has the points of one cell, and so of one part.
  int components = 1;
  double length = this->Points->Interpolate(number,
    [&](std::int32_t point)
    {
      components = this->Find(point).Array->GetNumberOfComponents();
      return this->GetComponent(point, 0);
    });
  for (int component = 1; component < components; ++component)
  {
    length = std::hypot(length,
      this->Points->Interpolate(number,
        [this, component](std::int32_t point) { return this->GetComponent(point, component); }));
  }
  return length;
}

//------------------------------------------------------------------------------
double ConcatenatedArray::operator()(std::int32_t number) const
{
  if (!this->Points || number < this->Points->GetFirstPoint())
  {
    return this->ValueOf(number);
  }
  if (this->Component == ScalarSelection::Magnitude)
  {
    return this->InterpolatedLength(number);
  }
  return this->Points->Interpolate(
    number, [this](std::int32_t point) { return this->ValueOf(point); });
}

//------------------------------------------------------------------------------
std::vector<double> GatherValues(const InputBlocks& input, int component,
  const std::vector<std::int32_t>& numbers, const WeightedPoints* points)
{
  const ConcatenatedArray valueOf(input, component, points);
  std::vector<double> values(numbers.size());
  ForEachInBlocks(
    values.size(), ThreadedLoop, [&](std::size_t i) { values[i] = valueOf(numbers[i]); });
  return values;
}

//------------------------------------------------------------------------------
std::string DescribeRounding(const InputBlocks& input, const ScalarDistribution& scalars)
{
  const bool hasWhole = std::any_of(input.Parts.begin(), input.Parts.end(),
    [](const InputPart& part)
    { return part.Scalars->GetDataTypeSize() == 8 && part.Scalars->GetDataType() != VTK_DOUBLE; });
  if (!hasWhole || scalars.IsEmpty())
  {
    return std::string();
  }
  const double largest = std::max(std::abs(scalars.GetLowest()), std::abs(scalars.GetHighest()));
  const double step = std::nextafter(largest, HUGE_VAL) - largest;
  if (step <= 1.0 || step <= (scalars.GetHighest() - scalars.GetLowest()) / 256.0)
  {
    return std::string();
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << "The scalars are whole numbers from "
       << scalars.GetLowest() << " to " << scalars.GetHighest()
       << ", where numbers of double precision are " << step
       << " apart: they are rounded to those; subtract a number near them before.";
  return text.str();
}

//------------------------------------------------------------------------------
FiniteValues::FiniteValues(const std::vector<double>& values)
{
  std::vector<ValueRange> ranges(NumberOfBlocks(values.size()));
  ForEachBlock(values.size(), ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      ValueRange range;
      for (std::size_t i = first; i < last; ++i)
      {
        range.Add(values[i]);
      }
      ranges[block] = range;
    });
  ValueRange all;
  for (const ValueRange& range : ranges)
  {
    all.Add(range);
  }
  this->NotFinite = all.NotFinite;
  if (all.Lowest <= all.Highest)
  {
    this->Distribution = ScalarDistribution(all.Lowest, all.Highest, values);
  }
}

}
