// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/IdView.h"
#include "Rendering/Input/PointsSource.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Mesh/Tetrahedralizer.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkCell;
class vtkDataSet;
class vtkUnstructuredGrid;

namespace meniscus
{

/** Points of cells that become points of tetrahedra. */
enum class CellPoints
{
  All,
  /** The corners only, for cells with shape functions (see ShapeOf()). */
  Corners
};

/**
 * Cells of data sets as tetrahedra: a view of the stored cells if the input is one
 * vtkUnstructuredGrid of tetrahedra, otherwise arrays of its own. Points and cells of several data
 * sets are numbered consecutively. Duplicate, hidden, refined and blanked cells (vtkGhostType) are
 * left out. The data sets must outlive this object.
 */
class TetrahedraSource
{
public:
  /**
   * @pre according to MeasureGrids(), 32 bits are enough for the indices of points, cells and
   *   tetrahedra.
   */
  TetrahedraSource(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop,
    CellPoints used = CellPoints::All);

  const TetrahedraView& GetView() const { return this->View; }

  /**
   * Types and numbers of the cells that are not drawn because of their type; empty if there are
   * none.
   */
  std::string DescribeOmitted() const;
  /**
   * Cells that are not used, because their arrays do not describe a cell. Those of a view are
   * tetrahedra with a point out of range, which the mesh counts.
   */
  const UnusableCells& GetUnusable() const { return this->Unusable; }
  /**
   * Number of cells that are folded inside out in parts, so that their tetrahedra overlap: their
   * points are in another order than VTK's, or those on edges lie elsewhere.
   */
  std::int64_t GetNumberOfFolded() const { return this->Folded; }
  /** True if other positions of the points could divide a cell into other tetrahedra. */
  bool SplitsByPosition() const { return this->PositionsDecide; }

private:
  struct Part;

  void ViewTetrahedra(vtkUnstructuredGrid* grid);
  void Tetrahedralize(
    const std::vector<vtkDataSet*>& grids, const RangeLoop& loop, CellPoints used);
  void TakeParts(const std::vector<Part>& parts, const RangeLoop& loop);

  PointsSource Points;
  TetrahedraView View;
  /** Cells of a view, or points of the tetrahedra. */
  IdView Stored;
  std::vector<std::int64_t> Ids;
  /** Cell of each tetrahedron. */
  std::vector<std::int32_t> Sources;
  /** Number of cells that are not drawn, by type. */
  std::map<int, std::int64_t> Omitted;
  std::int64_t Folded = 0;
  UnusableCells Unusable;
  bool PositionsDecide = false;
};

/** Number of points and tetrahedra of data sets, the latter if no cell is degenerate. */
struct GridSize
{
  std::int64_t Points = 0;
  std::int64_t Tetrahedra = 0;
  /** Lagrange and Bezier cells above order 1, which have no fixed division. */
  std::int64_t HigherOrder = 0;
};

/** Computes the size without creating tetrahedra. */
GridSize MeasureGrids(const std::vector<vtkDataSet*>& grids);

}
