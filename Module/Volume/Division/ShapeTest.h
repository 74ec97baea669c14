// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Division/CellPiece.h"
#include "Volume/Division/DivisionLimits.h"
#include "Volume/Division/ShapeFunctions.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus
{

/** Number of equal parts of an edge whose ends are sampled, at least. */
constexpr int LeastParts = 4;

/** Measures edges, faces and pieces; for use by one thread. */
class ShapeTest
{
public:
  ShapeTest(const PointFields& fields, const ShapeFunctionsMaker& functions,
    const DivisionMeasure& measure);

  /** Largest error of an edge that is drawn as its chord; its ends are sampled first. */
  double MeasureEdge(std::int32_t cell, const glm::vec3& from, const glm::vec3& to, int parts);
  /**
   * Largest error of an edge that is drawn as its chord.
   * @param a, b samples of its ends.
   * @param parts number of equal parts whose ends are sampled.
   */
  double MeasureEdge(std::int32_t cell, const glm::vec3& from, const glm::vec3& to,
    const CellSample& a, const CellSample& b, int parts);
  /**
   * Error of the linear shape of some corners of a piece, 3 or 4 of them, in their middle.
   * @param points samples of all points.
   */
  double MeasureMiddle(
    const CellPiece& piece, const int* corners, int count, const std::vector<CellSample>& points);

private:
  /** A value as an edge or a piece draws it. */
  struct DrawnValue
  {
    /** False where nothing else is known. */
    bool IsKnown = false;
    double Lowest = 0.0;
    double Highest = 0.0;
    /** Slope along an edge, by length, and the edge's length; 0 in a piece. */
    double Slope = 0.0;
    double Length = 0.0;
    /** Smallest slope in the direction in which it is steepest; 0 if it is not known. */
    double Gradient = 0.0;
  };
  using DrawnValues = std::array<DrawnValue, CellSample::MostFields>;

  DrawnValues ValuesOf(const CellSample& a, const CellSample& b, double length) const;
  DrawnValues ValuesOf(const std::array<CellSample, 4>& corners) const;
  void SetGradients(
    std::int32_t cell, const glm::vec3& from, const glm::vec3& to, DrawnValues& values);
  double ErrorOf(const CellSample& sample, const CellSample& drawn, double distance,
    const DrawnValues& edge) const;
  double ValueError(std::size_t field, double value, double drawn, const DrawnValue& edge) const;

  CellSampler Sampler;
  const DivisionMeasure& Measure;
  std::size_t NumberOfFields;
};

}
