// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef GridView_h
#define GridView_h

#include "Volume/TetrahedralMesh.h"
#include "Volume/Tetrahedralizer.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkCell;
class vtkDataArray;
class vtkUnstructuredGrid;

namespace meniscus
{

/**
 * A grid's cells as tetrahedra: where they are stored, if all are tetrahedra, else in an array of
 * its own. Duplicate and hidden cells (vtkGhostType) are left out. The grid must outlive it.
 */
class GridView
{
public:
  explicit GridView(vtkUnstructuredGrid* grid);

  const TetrahedraView& GetView() const { return this->View; }

  /** Cells that are not drawn because of their type, with their numbers; empty if there are none.
   */
  std::string DescribeOmitted() const;

private:
  void ViewPoints(vtkDataArray* points);
  void ViewTetrahedra(vtkUnstructuredGrid* grid);
  void Tetrahedralize(vtkUnstructuredGrid* grid);
  void AddCell(vtkUnstructuredGrid* grid, std::int64_t cell, int type);
  bool AddByFaces(vtkCell* cell);

  TetrahedraView View;
  std::vector<double> Points;
  std::vector<std::int64_t> Ids;
  Tetrahedralizer Tetrahedra;
  /** The cell of each tetrahedron. */
  std::vector<std::int32_t> Sources;
  /** Cells by type that are not drawn. */
  std::map<int, std::int64_t> Omitted;
  /** Whether quadratic triangles may belong to other cells than tetrahedra. */
  bool QuadraticByFaces = false;
};

}

#endif
