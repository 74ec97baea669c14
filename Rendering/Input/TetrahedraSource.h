// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_TetrahedraSource_h
#define meniscus_Rendering_Input_TetrahedraSource_h

#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Mesh/Tetrahedralizer.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkCell;
class vtkDataArray;
class vtkDataSet;
class vtkUnstructuredGrid;

namespace meniscus
{

/**
 * The cells of data sets as tetrahedra: where they are stored, if it is one vtkUnstructuredGrid of
 * tetrahedra, else in arrays of its own. Points and cells of several are numbered through.
 * Duplicate, hidden and blanked cells (vtkGhostType) are left out. The data sets must outlive it.
 */
class TetrahedraSource
{
public:
  /** @pre  MeasureGrids() says that 32 bits can number their points, cells and tetrahedra. */
  TetrahedraSource(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop);

  const TetrahedraView& GetView() const { return this->View; }

  /** Cells that are not drawn because of their type, with their numbers; empty if there are none.
   */
  std::string DescribeOmitted() const;

private:
  struct Part;

  void ViewPoints(vtkDataArray* points);
  void CopyPoints(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop);
  void ViewTetrahedra(vtkUnstructuredGrid* grid);
  void Tetrahedralize(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop);
  void TakeParts(const std::vector<Part>& parts, const RangeLoop& loop);

  TetrahedraView View;
  std::vector<double> Points;
  std::vector<std::int64_t> Ids;
  /** The cell of each tetrahedron. */
  std::vector<std::int32_t> Sources;
  /** Cells by type that are not drawn. */
  std::map<int, std::int64_t> Omitted;
};

/** How many points and tetrahedra data sets have, the latter if no cell is degenerate. */
struct GridSize
{
  std::int64_t Points = 0;
  std::int64_t Tetrahedra = 0;
};

/** Counted without tetrahedra being made. */
GridSize MeasureGrids(const std::vector<vtkDataSet*>& grids);

}

#endif
