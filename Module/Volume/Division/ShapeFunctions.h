// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Division/WeightedPoints.h"
#include "Volume/Mesh/PointsView.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace meniscus
{

/**
 * Shape functions of the cells of a mesh, supplied by the caller. Two cells with a common face must
 * agree on it: a straight line between two points of the face, in the reference coordinates of
 * either cell, is the same curve with the same values.
 */
class ShapeFunctions
{
public:
  virtual ~ShapeFunctions();

  /**
   * Weights of the input's points at a place of a cell.
   * @param place in the cell's reference coordinates.
   */
  virtual void Weigh(std::int32_t cell, const glm::dvec3& place, PointWeights& row) = 0;

  /**
   * True if all functions of the cell are known to be linear along the straight line between two
   * places, so that it need not be sampled.
   */
  virtual bool IsLinear(std::int32_t cell, const glm::vec3& from, const glm::vec3& to);
};

/** Creates an object for use by one thread. */
using ShapeFunctionsMaker = std::function<std::unique_ptr<ShapeFunctions>()>;

/** Points of the input and their values; the points must outlive this object. */
struct PointFields
{
  PointsView Points;
  std::int64_t NumberOfPoints = 0;
  /** Values per point: up to four, each with its own tolerance. May be empty. */
  std::vector<std::vector<double>> Values;
  /** True if the length of the vector of all values counts, and not each on its own. */
  bool IsLength = false;

  /** Number of values that count. */
  std::size_t GetNumberOfFields() const { return this->IsLength ? 1 : this->Values.size(); }
};

/** Position and values at a place of a cell. */
struct CellSample
{
  static constexpr std::size_t MostFields = 4;

  glm::dvec3 Position{ 0.0 };
  std::array<double, MostFields> Values{};
};

/** Sample at a place with these weights. */
CellSample SampleOf(const PointFields& fields, const PointWeights& row);
/** Sample at a point of the input. */
CellSample SampleAt(const PointFields& fields, std::int32_t point);

/** Samples cells; for use by one thread. */
class CellSampler
{
public:
  CellSampler(const PointFields& fields, const ShapeFunctionsMaker& maker);

  CellSample Sample(std::int32_t cell, const glm::dvec3& place);
  bool IsLinear(std::int32_t cell, const glm::vec3& from, const glm::vec3& to)
  {
    return this->Functions->IsLinear(cell, from, to);
  }
  /** Weights at a place; valid until the next call. */
  const PointWeights& Weigh(std::int32_t cell, const glm::dvec3& place);

private:
  const PointFields& Fields;
  std::unique_ptr<ShapeFunctions> Functions;
  PointWeights Row;
};

}
