// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Coefficients of a cell's rays, in units of the mesh's radius. Fills three lines of a cache. */
struct alignas(64) GradedCellRow
{
  /** Places of coefficients in Values. */
  enum Column
  {
    /** Gradients of the barycentric weights of vertices 1, 2 and 3; NaN for a cell without a row.
     */
    Gradients = 0,
    /** grad(n^2) / 2 at the mesh's centre, if the cell's function of n^2 went on to there. */
    Force = 9,
    /** Derivative of the force, a symmetric matrix: xx, yy, zz, xy, xz, yz. */
    Derivative = 12,
    /** Squared length of the longest of the edges at the first vertex. */
    SquaredSize = 18,
    /**
     * Two bounds, by PackUpwards(): the largest sum of the sizes of the components of a column of
     * the derivative, and the largest sum of the sizes of a gradient's components.
     */
    NormAndLargestGradient = 19,
    /** Number of columns, a multiple of four. */
    Size = 20
  };

  double Values[Size];
  /** TetrahedralMesh::Cell::Links. */
  std::array<std::int32_t, 4> Links;

  /**
   * Two numbers >= 0 in the place of one, each rounded up to 21 binary digits: in the upper half
   * those of the first one, followed by what counts as 0, and in the lower half those of the
   * second one.
   */
  static double PackUpwards(double first, double second);
};
static_assert(sizeof(GradedCellRow) == 192, "three lines of a cache");

/**
 * Rows of all active cells of a mesh in a field. Flat and inverted cells have none: rays pass them
 * one by one. A row takes 192 bytes.
 */
class GradedCellTable
{
public:
  /** @param squaredIndices, terms as in GradedMedium; terms may be null. */
  void Build(const TetrahedralMesh& mesh, const std::vector<double>& squaredIndices,
    const std::vector<EdgeTerms>* terms, const RangeLoop& loop = SerialLoop);

  bool IsEmpty() const { return this->Rows.empty(); }
  const GradedCellRow& GetRow(std::int64_t cell) const
  {
    return this->Rows[static_cast<std::size_t>(cell)];
  }

private:
  std::vector<GradedCellRow> Rows;
};

}
