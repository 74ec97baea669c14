// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_DividedCells_h
#define meniscus_Rendering_Input_DividedCells_h

#include "Common/RangeLoop.h"
#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/InputBlocks.h"
#include "Volume/Division/CellDivision.h"
#include "Volume/Mesh/TetrahedralMesh.h"

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
  /** False: cells are split into tetrahedra between their points. */
  bool IsAdaptive = false;
  /** Largest distance between an edge and its chord, as a fraction of the points' diagonal. */
  double PlaceTolerance = 1e-5;
  /** Largest difference of the scalar, as a fraction of its range. */
  double ScalarTolerance = 5e-5;
  std::int64_t MostPieces = std::int64_t{ 1 } << 25;

  /** True if cells are divided alike; the limit of pieces is not compared. */
  bool DividesAs(const DivisionSettings& other) const
  {
    return this->IsAdaptive == other.IsAdaptive &&
      (!this->IsAdaptive ||
        (this->PlaceTolerance == other.PlaceTolerance &&
          this->ScalarTolerance == other.ScalarTolerance));
  }
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
  /** True if there are cells with shape functions of a higher degree; otherwise all is empty. */
  bool IsUsed() const { return this->Used; }

  /** Tetrahedra of the last division; valid until the tables are freed. */
  TetrahedraView GetView() const;
  /** Frees the tables of the view, but keeps those of the other methods. */
  void FreeView();
  /** True if other positions could divide a linear cell into other tetrahedra. */
  bool SplitsByPosition() const { return this->PositionsDecide; }
  /** Types and numbers of the cells that are not drawn; empty if there are none. */
  const std::string& GetOmitted() const { return this->Omitted; }
  /** Cells that are not used because their arrays do not describe a cell. */
  const UnusableCells& GetUnusable() const { return this->Unusable; }

  /**
   * True if the division is good enough for other positions or scalars: differences are at most
   * twice the tolerances. If these were not doubled, almost each change would cost a division,
   * since there are always edges that just keep them.
   */
  bool Holds(const DivisionRequest& request, const RangeLoop& loop) const;
  /** Positions of all points, for other positions of those of the input. */
  std::vector<double> ComputePositions(const InputBlocks& input, const RangeLoop& loop) const;

  const WeightedPoints& GetPoints() const { return this->Division.GetPoints(); }
  const DivisionCounts& GetCounts() const { return this->Division.GetCounts(); }
  /** Number of divisions since construction. */
  std::int64_t GetNumberOfDivisions() const { return this->Divisions; }
  std::int64_t GetBytes() const;

private:
  std::vector<double> ComputePositions(const PointsSource& points, const RangeLoop& loop) const;

  CellDivision Division;
  bool Used = false;
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

#endif
