// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Rendering/Input/CellPieces.h"
#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/InputBlocks.h"
#include "Volume/Division/CellDivision.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/ErrorScale.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace meniscus
{

class PointsSource;

/** Settings of the division of cells, as the user gives them. */
struct DivisionSettings
{
  /**
   * False: cells are split into tetrahedra between their points. In an input with cells that have
   * no such split, all cells above order 1 are divided as if it were true.
   */
  bool IsAdaptive = false;
  /**
   * Largest error along the edges of the tetrahedra, as a fraction of the picture's full colour.
   * The default is a step of a display with 8 bits per channel. A displacement counts as four times
   * its fraction of the mesh's diagonal, so that the default is a pixel of a picture in which the
   * mesh is 1024 pixels long.
   */
  double Tolerance = 1.0 / 256.0;
  /** Budget of tetrahedra; 0 stands for a multiple of the number by the fixed division. */
  std::int64_t MostPieces = 0;

  /** Reason why the settings cannot be used; empty if they can. */
  std::string DescribeFault() const;
};

/** Division of the cells of an input, and the scalars that it is made for. */
struct DivisionRequest
{
  DivisionSettings Settings;
  /** Data sets and scalars; scalars of cells do not count. */
  InputBlocks Fields;
  /** As in ScalarSelection; Only stands for each of up to four components. */
  int Component = ScalarSelection::Only;
  /** Function by which a picture shows the scalar. */
  PictureFunction Picture;
  /** Length of a unit of the input's coordinates, in the unit of the attenuation. */
  double UnitLength = 1.0;
};

/** Cells of data sets as tetrahedra that follow their shape functions to a tolerance. */
class DividedCells
{
public:
  /**
   * Divides the cells. Those without shape functions (polyhedra, prisms) and those with a repeated
   * or invalid point are linear: their tetrahedra are only divided as their neighbours ask for.
   */
  DivisionStatus Divide(const DivisionRequest& request, const RangeLoop& loop,
    const std::function<bool(double)>& progress);
  /** Forgets the division. */
  void Clear();
  /** True if there are cells to divide; otherwise the mesh is the input's, and all is empty. */
  bool IsUsed() const { return this->Used; }

  /** Tetrahedra of the last division; valid until the tables are freed. */
  TetrahedraView GetView() const;
  /** Frees the tables of the view, but keeps the tables of the other methods. */
  void FreeView();
  /** True if other positions could divide a linear cell into other tetrahedra. */
  bool SplitsByPosition() const { return this->PositionsDecide; }
  /** Types and numbers of the cells that are not drawn; empty if there are none. */
  const std::string& GetOmitted() const { return this->Omitted; }
  /** Cells that are not used because their arrays do not describe a cell. */
  const UnusableCells& GetUnusable() const { return this->Unusable; }

  /**
   * True if the division is good enough for other positions, scalars or another function: errors
   * are at most twice the tolerance, or twice the error of the division if its budget ended it
   * earlier. If these were not doubled, almost each change would cost a division, since there are
   * always edges that just keep them.
   */
  bool Holds(const DivisionRequest& request, const RangeLoop& loop) const;
  /** Positions of all points of the pieces, after the input's points have moved. */
  std::vector<double> ComputePositions(const InputBlocks& input, const RangeLoop& loop) const;

  const WeightedPoints& GetPoints() const { return this->Division.GetPoints(); }
  const DivisionCounts& GetCounts() const { return this->Division.GetCounts(); }
  /**
   * Largest error in the edges of the tetrahedra. Cells that were measured and need no division
   * count as well, some of them by a bound of their error.
   */
  double GetError() const { return std::max(this->GetCounts().Error, this->Curved.Error); }
  /** Budget that the last division had. */
  std::int64_t GetBudget() const { return this->Budget; }
  /** Number of divisions since construction. */
  std::int64_t GetNumberOfDivisions() const { return this->Divisions; }
  std::int64_t GetBytes() const;

private:
  std::vector<double> ComputePositions(const PointsSource& points, const RangeLoop& loop) const;

  CellDivision Division;
  CurvedCells Curved;
  bool Used = false;
  std::int64_t Budget = 0;
  bool MatchPositions = false;
  bool PositionsDecide = false;
  std::string Omitted;
  UnusableCells Unusable;
  std::int64_t Divisions = 0;
  /** Tables of the view. */
  std::vector<double> Positions;
  std::vector<std::int32_t> Cells;
  std::vector<std::int32_t> Sources;
};

}
