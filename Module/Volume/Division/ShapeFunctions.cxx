// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/ShapeFunctions.h"

#include <cmath>

namespace meniscus
{

ShapeFunctions::~ShapeFunctions() = default;

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
  CellSample sample;
  double squares = 0.0;
  for (std::size_t i = 0; i < row.Points.size(); ++i)
  {
    sample.Position += row.Weights[i] * fields.Points[static_cast<std::size_t>(row.Points[i])];
  }
  for (std::size_t field = 0; field < fields.Values.size(); ++field)
  {
    const std::vector<double>& values = fields.Values[field];
    double sum = 0.0;
    for (std::size_t i = 0; i < row.Points.size(); ++i)
    {
      sum += row.Weights[i] * values[static_cast<std::size_t>(row.Points[i])];
    }
    squares += sum * sum;
    if (!fields.IsLength)
    {
      sample.Values[field] = sum;
    }
  }
  if (fields.IsLength)
  {
    sample.Values[0] = std::sqrt(squares);
  }
  return sample;
}

//------------------------------------------------------------------------------
CellSample SampleAt(const PointFields& fields, std::int32_t point)
{
  const auto index = static_cast<std::size_t>(point);
  CellSample sample;
  sample.Position = fields.Points[index];
  double squares = 0.0;
  for (std::size_t field = 0; field < fields.Values.size(); ++field)
  {
    const double value = fields.Values[field][index];
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

//------------------------------------------------------------------------------
CellSample CellSampler::Sample(std::int32_t cell, const glm::dvec3& place)
{
  return SampleOf(this->Fields, this->Weigh(cell, place));
}

}
