// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surface/SolidCells.h"

#include <vector>

namespace meniscus
{

/**
 * Continues values of points harmonically to other points of a mesh: linear finite elements for
 * Laplace's equation, so that a linear field is continued exactly. The values stay between the
 * smallest and the largest given values, as in harmonic functions.
 */
class HarmonicField
{
public:
  /** Sets up the equations. Points with `given` keep their values. */
  HarmonicField(const TetrahedronCells& cells, const std::vector<bool>& given);

  /**
   * Computes the values of the other points. Returns false if a given value is not finite or the
   * iteration did not converge; the values are then not the solution.
   * @pre every connected part of the mesh has a point with `given`.
   */
  bool Continue(std::vector<double>& values) const;

private:
  void Multiply(const std::vector<double>& x, std::vector<double>& product) const;

  /** Rows of the stiffness matrix: all points, off-diagonal entries by columns. */
  std::vector<std::size_t> RowBegin;
  std::vector<int> Columns;
  std::vector<double> Entries;
  std::vector<double> Diagonal;
  std::vector<bool> Given;
};

} // namespace meniscus
