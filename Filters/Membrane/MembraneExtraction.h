// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Membrane_MembraneExtraction_h
#define meniscus_Filters_Membrane_MembraneExtraction_h

#include "Refraction/Membrane/Membrane.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkImplicitFunction;
class vtkPolyData;

namespace meniscus
{

/** A membrane's triangles as plain arrays. Two of them are equal if the same surface comes out. */
struct MembraneArrays
{
  std::vector<double> Points;
  std::vector<double> Normals; ///< empty if the input has none that fit
  std::vector<std::int64_t> Triangles;
  std::vector<std::int64_t> CellIds; ///< cell of the input, per triangle
  bool NormalsRejected = false;      ///< there are normals, of the wrong size

  bool operator==(const MembraneArrays& other) const;
  MembraneInput AsInput() const;
};

/**
 * Triangles of the polygons and strips of `membrane`, in the order of its cells; other polygons are
 * split by vtkTriangleFilter. What cannot be split is handed on as a triangle that validation
 * will skip and count.
 */
MembraneArrays ExtractMembrane(vtkPolyData* membrane);

/**
 * Moves the points of the triangles onto the zero set of `function`, by Newton's method along its
 * gradient, and makes its gradients there their normals, on the side that the membrane's normals
 * are on or, if it has none, the facets' winding. Returns the number of points that have no place
 * on the zero set; these keep their place, and a normal of zeros, for which one is computed.
 */
std::size_t FitToFunction(vtkImplicitFunction* function, MembraneArrays& arrays);

}

#endif
