// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/Membrane.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkImplicitFunction;
class vtkPolyData;

namespace meniscus
{

/**
 * Triangles of a membrane as plain arrays. Two of them compare equal if they give the same surface.
 */
struct MembraneArrays
{
  std::vector<double> Points;
  std::vector<double> Normals; ///< empty if the input has none of a matching size
  std::vector<std::int64_t> Triangles;
  std::vector<std::int64_t> CellIds; ///< cell of the input that each triangle comes from
  bool NormalsRejected = false;      ///< the input has normals, but their number is wrong

  bool operator==(const MembraneArrays& other) const;
  MembraneInput AsInput() const;
  /** Reverses normals and windings. */
  void Turn();
};

/**
 * Latest modification time of a membrane and of the objects that hold its values. The time of a
 * vtkPolyData itself does not cover the arrays of its cells.
 */
vtkMTimeType GetMembraneTime(vtkPolyData* membrane);

/**
 * Triangles of the polygons and strips of `membrane`, in the order of its cells. Other polygons
 * than triangles are split by vtkTriangleFilter or, where it leaves parts out, by DividePolygon. A
 * polygon that cannot be split becomes an invalid triangle, which validation skips and counts.
 */
MembraneArrays ExtractMembrane(vtkPolyData* membrane);

/**
 * Moves the points of the triangles onto the zero set of `function`, by Newton's method along its
 * gradient. Replaces their normals by the gradients there, on the side of the membrane's normals
 * or, if it has none, of the facets' winding. Returns the number of points for which no place on
 * the zero set is found; these keep their position and get a zero normal, which is computed later.
 */
std::size_t FitToFunction(vtkImplicitFunction* function, MembraneArrays& arrays);

}
