// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells of data sets that have to be divided, and their tetrahedra before that.
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Division/CellPiece.h"
#include "Volume/Division/DivisionLimits.h"
#include "Volume/Division/ShapeFunctions.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

class vtkDataSet;

namespace meniscus
{

/** True if there are types of cells with shape functions of a higher degree. */
bool MayBeCurved(const std::vector<vtkDataSet*>& grids);

/** Cells that are divided. */
struct CurvedCells
{
  /**
   * Degree of the shape functions of each cell; 0 for cells that are drawn by tetrahedra between
   * their corners without an error above the limit, and for cells with a point that is repeated,
   * out of range or not finite.
   */
  std::vector<std::uint8_t> Degrees;
  bool IsEmpty = true;
  /** Largest error of the cells of degree 1 that were measured and are not divided, or a bound. */
  double Error = 0.0;
};

/**
 * Finds the cells to divide. Cells of degree 1 are measured; all cells above that are divided.
 * @param leastDegree lowest degree of cells that are not taken as linear.
 * @param most error that may be drawn.
 */
CurvedCells FindCurvedCells(const std::vector<vtkDataSet*>& grids, const PointFields& fields,
  const DivisionMeasure& measure, double most, int leastDegree, const RangeLoop& loop);

/** Tetrahedra between the corners of cells. */
struct CellPieces
{
  /** Those of curved cells, and those that may share an edge with them. */
  std::vector<CellPiece> Pieces;
  /** Points of the others, four each, -1 for a point out of range; and their cells. */
  std::vector<std::int32_t> Others;
  std::vector<std::int32_t> OtherCells;
};

/** @param view tetrahedra between the corners of the cells, with their source cells. */
CellPieces CollectPieces(
  const std::vector<vtkDataSet*>& grids, const TetrahedraView& view, const CurvedCells& curved);

}
