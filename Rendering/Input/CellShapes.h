// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Shapes and shape functions of VTK's cells, for their division into tetrahedra.
#pragma once

#include "Volume/Division/ShapeFunctions.h"

#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <cstdint>
#include <vector>

class vtkDataSet;

namespace meniscus
{

/** Shape of a cell type with shape functions. */
struct CellShape
{
  /** Type of the linear cell with the same corners; VTK_EMPTY_CELL for other types. */
  int LinearType = 0;
  /** The corners are the first points of the cell. */
  int NumberOfCorners = 0;
  /**
   * Degree of the shape functions along an axis: 0 if they are linear, and Varying if it depends on
   * the cell. 3 also stands for functions that vanish on all edges of a face.
   */
  int Degree = 0;

  static constexpr int Varying = -1;
  static constexpr int SecondOrder = 2;
  bool IsKnown() const { return this->NumberOfCorners > 0; }
};

/** Properties of a cell type. */
struct CellKind
{
  int Type = 0;
  /** Unknown for types without shape functions, such as polyhedra. */
  CellShape Shape;
  /** Least number of points; 0 for types whose number of points is not fixed. */
  vtkIdType LeastPoints = 0;
  /**
   * Number of tetrahedra, unless the cell is degenerate; for Lagrange and Bezier cells, the number
   * between the corners.
   */
  int Tetrahedra = 1;
  /** Index, in the cell, of the point inside it, or -1. */
  int Center = -1;
};

/** Properties of a type; the defaults for types that are not drawn, and for polyhedra. */
const CellKind& KindOf(int type);

inline const CellShape& ShapeOf(int type)
{
  return KindOf(type).Shape;
}

/**
 * Type of the linear cell with the same points and shape functions: Lagrange and Bezier cells of
 * order 1 have one. Other cells keep their type.
 */
int ResolveCellType(int type, vtkIdType numberOfPoints);

/** True if VTK has a class that evaluates cells of this type. */
bool HasCellClass(int type);

/**
 * Reference coordinates of a corner: VTK's parametric coordinates. For pyramids, those along the
 * base are multiplied by the distance from the apex, so that straight lines on a face are the same
 * for the cells on both sides.
 */
glm::dvec3 PlaceOfCorner(const CellShape& shape, int corner);

/** Shape functions of the cells of data sets, which are numbered consecutively. */
class GridShapeFunctions : public ShapeFunctions
{
public:
  /** @param grids must outlive this object. */
  explicit GridShapeFunctions(const std::vector<vtkDataSet*>& grids);

  void Weigh(std::int32_t cell, const glm::dvec3& place, PointWeights& row) override;
  bool IsLinear(std::int32_t cell, const glm::vec3& from, const glm::vec3& to) override;
  /** Degree of the shape functions of a cell whose type has shape functions. */
  int GetDegree(std::int32_t cell);

private:
  void Load(std::int32_t cell);
  void Evaluate(const glm::dvec3& place);

  const std::vector<vtkDataSet*>& Grids;
  /** Numbers of the first point and cell of each data set. */
  std::vector<std::int64_t> FirstPoints;
  std::vector<std::int64_t> FirstCells;
  /** The cell that was evaluated last; Generic is loaded for types without functions of their own.
   */
  std::int32_t Loaded = -1;
  int Type = 0;
  std::int64_t FirstPoint = 0;
  vtkNew<vtkIdList> Ids;
  vtkNew<vtkGenericCell> Generic;
  std::vector<double> Weights;
};

}
