// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceMesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus::reference
{

/** A ray of light with the momentum p, |p| = n, and the optical path so far. */
struct LightRay
{
  Vector3 Position{};
  Vector3 Momentum{};
  double OpticalPath = 0.0;
};

/** One step of the classical Runge-Kutta method for dx/ds = p, dp/ds = force(x). */
LightRay RungeKuttaStep(
  const LightRay& ray, double step, const std::function<Vector3(const Vector3&)>& force);

/**
 * Rays in cells with a linear or quadratic n^2 by the Runge-Kutta method with small steps. The next
 * cell is found among all cells by its barycentric weights; the last step in a cell is bisected.
 */
class GradedRayIntegrator
{
public:
  /**
   * Arrays of points (xyz), cells (4 ids each), n^2 of each point and, for each cell, the factors
   * of the products of weights of the edges 01, 02, 03, 12, 13, 23.
   */
  GradedRayIntegrator(const std::vector<double>& points, const std::vector<std::int64_t>& cells,
    const std::vector<double>& squaredIndices, const std::vector<double>& edgeTerms);

  /** Follows a ray that begins on the boundary until it is outside of all cells. */
  LightRay Follow(LightRay ray, double step) const;

  /** n^2 at a place in a cell or, by the function of the nearest one, just outside of it. */
  double SquaredIndexAt(const Vector3& position) const;

private:
  struct Cell
  {
    std::array<Vector3, 4> Gradients;
    std::array<double, 4> Offsets;
    Vector3 Force;
    /** n^2 at the origin. */
    double SquaredIndex;
    std::array<double, 6> EdgeTerms;
  };
  static Vector3 ForceAt(const Cell& cell, const Vector3& position);
  /** Smallest barycentric weight. */
  static double WeightOf(const Cell& cell, const Vector3& position);
  const Cell* Find(const Vector3& position) const;

  std::vector<Cell> Cells;
};

}
