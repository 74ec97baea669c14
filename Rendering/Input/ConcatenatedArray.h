// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Input/InputBlocks.h"
#include "Volume/Division/WeightedPoints.h"
#include "Volume/Optics/ScalarNormalization.h"

#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;

namespace meniscus
{

/** Concatenation of the arrays of all parts, with a running index. */
class ConcatenatedArray
{
public:
  /**
   * @param component as in ScalarSelection; the first one for Only. For an array of one component,
   *   it is ignored.
   * @param points interpolated points, numbered after the points of the arrays; null if there are
   *   none. Must outlive this object.
   */
  ConcatenatedArray(
    const InputBlocks& input, int component, const WeightedPoints* points = nullptr);

  double operator()(std::int32_t number) const;
  /** A component of a tuple of the arrays; 0 beyond the components of its part. */
  double GetComponent(std::int32_t number, int component) const;

private:
  /** A tuple of one part. */
  struct Tuple
  {
    vtkDataArray* Array;
    vtkIdType Number;
  };
  Tuple Find(std::int32_t number) const;
  double ValueOf(std::int32_t number) const;
  double InterpolatedLength(std::int32_t number) const;

  const InputBlocks& Input;
  int Component;
  const WeightedPoints* Points;
  std::vector<std::int64_t> Firsts;
};

/** Values with the given indices, as stored in the arrays, or interpolated. */
std::vector<double> GatherValues(const InputBlocks& input, int component,
  const std::vector<std::int32_t>& numbers, const WeightedPoints* points);

/**
 * Warning about whole numbers that double precision rounds by more than 1/256 of their range; empty
 * if there are none.
 */
std::string DescribeRounding(const InputBlocks& input, const ScalarDistribution& scalars);

/** The finite values of a list. */
struct FiniteValues
{
  ScalarDistribution Distribution;
  std::int64_t NotFinite = 0;

  FiniteValues() = default;
  explicit FiniteValues(const std::vector<double>& values);
};

}
