// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/WeightedPoints.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void PointWeights::Clear()
{
  this->Points.clear();
  this->Weights.clear();
}

//------------------------------------------------------------------------------
void PointWeights::Add(std::int32_t point, double weight)
{
  if (weight != 0.0)
  {
    this->Points.push_back(point);
    this->Weights.push_back(weight);
  }
}

//------------------------------------------------------------------------------
void WeightedPoints::Add(const PointWeights& row)
{
  this->Points.insert(this->Points.end(), row.Points.begin(), row.Points.end());
  this->Weights.insert(this->Weights.end(), row.Weights.begin(), row.Weights.end());
  this->Ends.push_back(this->Points.size());
}

//------------------------------------------------------------------------------
void WeightedPoints::Append(const WeightedPoints& other)
{
  const std::size_t offset = this->Points.size();
  this->Points.insert(this->Points.end(), other.Points.begin(), other.Points.end());
  this->Weights.insert(this->Weights.end(), other.Weights.begin(), other.Weights.end());
  for (const std::size_t end : other.Ends)
  {
    this->Ends.push_back(offset + end);
  }
}

//------------------------------------------------------------------------------
void WeightedPoints::Shrink(std::int64_t size)
{
  this->Ends.resize(static_cast<std::size_t>(size));
  const std::size_t entries = this->Ends.empty() ? 0 : this->Ends.back();
  this->Points.resize(entries);
  this->Weights.resize(entries);
}

//------------------------------------------------------------------------------
std::int64_t WeightedPoints::GetBytes() const
{
  return static_cast<std::int64_t>(this->Ends.capacity() * sizeof(std::size_t) +
    this->Points.capacity() * sizeof(std::int32_t) + this->Weights.capacity() * sizeof(double));
}

}
