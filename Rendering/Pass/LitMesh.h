// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkType.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class vtkCellArray;
class vtkIdTypeArray;

namespace meniscus
{

/**
 * Triangles of an object, each divided by a regular grid, on which its light is computed, and
 * tables by which a shader finds the places of the grid around a point of the object. Triangles
 * that share corners and have equal grids share the places of their common side.
 */
class LitMesh
{
public:
  /** A triangle of a polygon or a strip. */
  struct Face
  {
    std::array<vtkIdType, 3> Corners;
    vtkIdType Source;
    double Length; ///< of the longest side
  };

  /** Triangles of a surface by their sources; parameters as of Build(). */
  static std::vector<Face> ListFaces(vtkPolyData* surface, vtkIdTypeArray* sources);

  /**
   * Divides the polygons and strips of a surface into about `cells` cells, and no fewer than its
   * triangles. Triangles with coordinates that are not finite are left out.
   * @param sources ids of the object's cells that the surface's cells come from; null if they are
   *   the same.
   */
  void Build(vtkPolyData* surface, vtkIdTypeArray* sources, int cells);

  /** Points and triangles of all grids. */
  vtkPolyData* GetCells() const { return this->Cells; }
  /** Point of each place of each grid: rows of n + 1, n, ... 1 places from the first corner on. */
  const std::vector<vtkIdType>& GetPlaces() const { return this->Places; }
  /** Point that the corners in GetFaces() are relative to: the middle of the surface. */
  const glm::dvec3& GetOrigin() const { return this->Origin; }
  /**
   * Three texels of four numbers for each triangle: a corner and the number of divisions; the next
   * corner, which the rows lead to, and the first of its places; the last corner, and the number of
   * triangles behind it that come from the same cell.
   */
  const std::vector<float>& GetFaces() const { return this->Faces; }
  /**
   * First triangle of the cell that each primitive of the object's images comes from, in the order
   * in which VTK's mapper draws them; -1 for points, lines and cells without triangles.
   */
  std::vector<std::int32_t> ListPrimitives(vtkPolyData* images) const;

private:
  void AddTriangles(std::size_t start, int divisions, vtkCellArray* triangles) const;

  vtkNew<vtkPolyData> Cells;
  glm::dvec3 Origin{ 0.0 };
  std::vector<vtkIdType> Places;
  std::vector<float> Faces;
  std::vector<std::int32_t> FirstFaces; ///< of the object's cells; -1 for none
};

}
