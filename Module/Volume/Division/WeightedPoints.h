// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Points of the input and the weights with which their values are summed up. */
struct PointWeights
{
  std::vector<std::int32_t> Points;
  std::vector<double> Weights;

  void Clear();
  /** Adds a point, unless its weight is 0: a value that is not finite would count otherwise. */
  void Add(std::int32_t point, double weight);
};

/**
 * Points with values interpolated from the input's points, in compressed rows. They are numbered
 * after the points of the input.
 */
class WeightedPoints
{
public:
  WeightedPoints() = default;
  /** @param firstPoint number of points of the input. */
  explicit WeightedPoints(std::int64_t firstPoint)
    : FirstPoint(firstPoint)
  {
  }

  void Add(const PointWeights& row);
  /** Adds the rows of another table, which begin with the same point of the input. */
  void Append(const WeightedPoints& other);

  /** Removes the last rows. @param size number of rows to keep. */
  void Shrink(std::int64_t size);

  bool IsEmpty() const { return this->Ends.empty(); }
  std::int64_t GetSize() const { return static_cast<std::int64_t>(this->Ends.size()); }
  /** Number of the first interpolated point. */
  std::int64_t GetFirstPoint() const { return this->FirstPoint; }
  std::int64_t GetBytes() const;

  /**
   * Value of a point of the input or of an interpolated one.
   * @param valueOf the value of a point of the input.
   */
  template <typename ValueOf>
  auto Interpolate(std::int64_t point, ValueOf&& valueOf) const
    -> decltype(valueOf(std::int32_t{ 0 }))
  {
    using Value = decltype(valueOf(std::int32_t{ 0 }));
    if (point < this->FirstPoint)
    {
      return valueOf(static_cast<std::int32_t>(point));
    }
    const auto row = static_cast<std::size_t>(point - this->FirstPoint);
    Value sum(0);
    for (std::size_t i = row > 0 ? this->Ends[row - 1] : 0; i < this->Ends[row]; ++i)
    {
      sum += this->Weights[i] * valueOf(this->Points[i]);
    }
    return sum;
  }

private:
  std::int64_t FirstPoint = 0;
  /** One past the last entry of each row. */
  std::vector<std::size_t> Ends;
  std::vector<std::int32_t> Points;
  std::vector<double> Weights;
};

}
