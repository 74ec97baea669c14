// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestMeshes.h"

namespace meniscus::test
{

/** A cell of VTK: its type and its points in VTK's order. */
struct MeshCell
{
  int Type = VTK_TETRA;
  std::vector<vtkIdType> Ids;
};

/** An unstructured grid as plain arrays in double precision, which relations rewrite. */
struct MeshArrays
{
  std::vector<glm::dvec3> Points;
  std::vector<MeshCell> Cells;
  int Components = 1;
  /** True if values belong to cells, false if they belong to points. */
  bool OnCells = false;
  /** Components of the first tuple, of the second, ... */
  std::vector<double> Values;

  std::size_t Tuples() const { return this->OnCells ? this->Cells.size() : this->Points.size(); }
  double GetValue(std::size_t tuple, int component) const
  {
    return this->Values[tuple * static_cast<std::size_t>(this->Components) + component];
  }
  /** Appends a tuple of another mesh with the same number of components. */
  void AddTuple(const MeshArrays& from, std::size_t tuple);
  /** Appends a point or a cell of another mesh with its value or tuple. */
  vtkIdType AddPoint(const MeshArrays& from, std::size_t point);
  void AddCell(const MeshArrays& from, std::size_t cell);

  void GetBounds(double result[6]) const;
  /** Smallest and largest finite value of a component. */
  std::array<double, 2> MakeRange(int component) const;
  bool IsTetrahedral() const;
};

/** Storage of a mesh in VTK. */
struct MeshStorage
{
  int PointType = VTK_DOUBLE;
  int ValueType = VTK_DOUBLE;
  /** True: 32-bit ids in the cell array; false: 64-bit ids. */
  bool SmallIds = false;
  /** One array per component for points and values. */
  bool PerComponent = false;
};

/** Values must be representable in the types of the storage. */
Grid ToGrid(const MeshArrays& mesh, const MeshStorage& storage = MeshStorage());

/** The active point scalars of a grid, or its active cell scalars. */
MeshArrays ToArrays(vtkUnstructuredGrid* grid, bool onCells = false);

/** A tetrahedron of a mesh: four points, and the cell to which it belongs. */
struct MeshTetrahedron
{
  std::array<std::int64_t, 4> Ids;
  std::size_t Cell;
};

/**
 * Tetrahedra of all cells, by the rule that the mapper documents: a cell is split by pulling its
 * lowest-numbered point, and so is each face.
 */
std::vector<MeshTetrahedron> TetrahedraOf(const MeshArrays& mesh);

} // namespace meniscus::test
