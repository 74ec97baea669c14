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

struct GradedCell;

/**
 * Bounds of the steps of lanes through a cell, by the time t that they take.
 *
 * With n from n0 to n1 in the cell, the largest force B and the norm N of its derivative, the terms
 * of a way are at most n1 t, B t^2 / 2, and by a factor of N t^2 / ((k - 1) k) smaller at the order
 * k than at the order k - 2. With the largest gradient G of a weight, the terms of a weight above
 * the second order have a sum of at most N t^2 / 6 (1 + N t^2 / 20 + ...) K t with
 * K = G (n1 + B t), in which t may be as long as LongestTime.
 */
struct GradedStepBounds
{
  /**
   * Times up to this one have bounds: the terms left out are a share of at most LargestRest of the
   * way, and a way is not longer than two detours about the cell.
   */
  double LongestTime = 0.0;
  /** The steps of a zigzag, as GradedRayWalk looks for them, do not take longer. */
  double ShortTime = 0.0;
  /**
   * Twice the terms of a weight above the second order and the rounding of all terms are at most
   * t (Linear + Cubic t^2), with Linear = 2 GradedPassage::Rounding K and Cubic = 0.4 N K. Terms of
   * its rate above the first order are at most 1.25 Cubic t^2.
   */
  double Linear = 0.0;
  double Cubic = 0.0;

  /** Terms of the series up to this order are summed. */
  static constexpr int Order = 5;
  /**
   * Largest share of the way in a cell that the terms left out may be. Over a path of the length of
   * the mesh's radius they add up to 2^-15 of the rounding of the mesh's positions.
   */
  static constexpr double LargestRest = 0x1p-46;

  /** @param norm of the derivative of the force; 0 for a linear n^2. */
  GradedStepBounds(const GradedCell& cell, double norm);
};

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
    /** GradedStepBounds::LongestTime and ShortTime, by PackUpwards(). */
    Times = 18,
    /** GradedStepBounds::Linear and Cubic, by PackUpwards(). */
    HigherTerms = 19,
    /** Number of columns, a multiple of four. */
    Size = 20
  };

  double Values[Size];
  /** TetrahedralMesh::Cell::Links. */
  std::array<std::int32_t, 4> Links;

  /**
   * Two numbers >= 0 in the place of one, each rounded up to 21 binary digits: in the upper half
   * those of the first one, and in the lower half those of the second one. As a number, the pair is
   * the first one, up to 2^-19 larger than before.
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
