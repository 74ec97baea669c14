// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Division_ShapeTest_h
#define meniscus_Volume_Division_ShapeTest_h

#include "Volume/Division/CellPiece.h"
#include "Volume/Division/ShapeFunctions.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** Accuracy of a division. */
struct DivisionLimits
{
  /** Largest distance between a curved edge and its chord. */
  double Place = 0.0;
  /** Largest difference of each value. */
  std::array<double, CellSample::MostFields> Values{};
  /**
   * Number of divisions, at most, that lead to a point. 23 are the most for which reference
   * coordinates are exact in single precision.
   */
  int MostLevels = 23;
  std::int64_t MostPieces = std::numeric_limits<std::int32_t>::max();
};

/** Tests edges, faces and pieces against the limits; for use by one thread. */
class ShapeTest
{
public:
  ShapeTest(
    const PointFields& fields, const ShapeFunctionsMaker& functions, const DivisionLimits& limits);

  /** Compares an edge with its chord; its ends are sampled first. */
  bool IsEdgeStraight(std::int32_t cell, const glm::vec3& from, const glm::vec3& to, int parts);
  /**
   * Compares an edge with its chord.
   * @param a, b samples of its ends.
   * @param parts number of equal parts whose ends are sampled.
   */
  bool IsEdgeStraight(std::int32_t cell, const glm::vec3& from, const glm::vec3& to,
    const CellSample& a, const CellSample& b, int parts);
  /**
   * Compares the middle of some corners of a piece, 3 or 4 of them, with its linear shape.
   * @param points samples of all points.
   */
  bool IsMiddleStraight(
    const CellPiece& piece, const int* corners, int count, const std::vector<CellSample>& points);

private:
  bool AreClose(const CellSample& sample, const CellSample& drawn, double distance) const;

  CellSampler Sampler;
  const DivisionLimits& Limits;
  std::size_t NumberOfFields;
};

}

#endif
