// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/ShapeFunctions.h"

#include <cmath>

namespace meniscus
{
namespace
{

/** Sample with a position and the value that `valueOf` gives for each list of values. */
template <typename ValueOf>
CellSample MakeSample(const PointFields& fields, const glm::dvec3& position, const ValueOf& valueOf)
{
  CellSample sample;
  sample.Position = position;
  double squares = 0.0;
  for (std::size_t field = 0; field < fields.Values.size(); ++field)
  {
    const double value = valueOf(fields.Values[field]);
    squares += value * value;
    if (!fields.IsLength)
    {
      sample.Values[field] = value;
    }
  }
  if (fields.IsLength)
  {
    sample.Values[0] = std::sqrt(squares);
  }
  return sample;
}

}

//------------------------------------------------------------------------------

ShapeFunctions::~ShapeFunctions() = default;

//------------------------------------------------------------------------------
bool ShapeFunctions::IsLinear(std::int32_t, const glm::vec3&, const glm::vec3&)
{
  return false;
}

//------------------------------------------------------------------------------
CellSampler::CellSampler(const PointFields& fields, const ShapeFunctionsMaker& maker)
  : Fields(fields)
  , Functions(maker())
{
}

//------------------------------------------------------------------------------
const PointWeights& CellSampler::Weigh(std::int32_t cell, const glm::dvec3& place)
{
  this->Row.Clear();
  this->Functions->Weigh(cell, place, this->Row);
  return this->Row;
}

//------------------------------------------------------------------------------
CellSample SampleOf(const PointFields& fields, const PointWeights& row)
{
  glm::dvec3 position(0.0);
  for (std::size_t i = 0; i < row.Points.size(); ++i)
  {
    position += row.Weights[i] * fields.Points[static_cast<std::size_t>(row.Points[i])];
  }
  const auto valueOf = [&row](const std::vector<double>& values)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < row.Points.size(); ++i)
    {
      sum += row.Weights[i] * values[static_cast<std::size_t>(row.Points[i])];
    }
    return sum;
  };
  return MakeSample(fields, position, valueOf);
}

//------------------------------------------------------------------------------
CellSample SampleAt(const PointFields& fields, std::int32_t point)
{
  const auto index = static_cast<std::size_t>(point);
  return MakeSample(fields, fields.Points[index],
    [index](const std::vector<double>& values) { return values[index]; });
}

//------------------------------------------------------------------------------
CellSample CellSampler::Sample(std::int32_t cell, const glm::dvec3& place)
{
  return SampleOf(this->Fields, this->Weigh(cell, place));
}

}
