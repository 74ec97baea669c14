// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestMeshes.h"

namespace meniscus::test
{

/** A type of cell with other shape functions than a linear tetrahedron. */
struct CellCase
{
  const char* Name;
  int Type;
  vtkIdType Points;
  /** Random displacement of the points. Cells of high order take more pieces. */
  double Displacement = 0.02;
};

constexpr CellCase CellCases[] = { { "hexahedron", VTK_HEXAHEDRON, 8 }, { "wedge", VTK_WEDGE, 6 },
  { "pyramid", VTK_PYRAMID, 5 }, { "quadratic tetrahedron", VTK_QUADRATIC_TETRA, 10 },
  { "quadratic hexahedron", VTK_QUADRATIC_HEXAHEDRON, 20 },
  { "triquadratic hexahedron", VTK_TRIQUADRATIC_HEXAHEDRON, 27 },
  { "quadratic wedge", VTK_QUADRATIC_WEDGE, 15 },
  { "biquadratic wedge", VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18 },
  { "quadratic pyramid", VTK_QUADRATIC_PYRAMID, 13 },
  { "Lagrange tetrahedron of order 3", VTK_LAGRANGE_TETRAHEDRON, 20, 0.01 },
  { "Lagrange hexahedron of order 3", VTK_LAGRANGE_HEXAHEDRON, 64, 0.003 },
  { "Bezier tetrahedron of order 3", VTK_BEZIER_TETRAHEDRON, 20, 0.005 },
  { "quadratic-linear wedge", VTK_QUADRATIC_LINEAR_WEDGE, 12 },
  { "biquadratic hexahedron", VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24 },
  { "Lagrange wedge of order 2", VTK_LAGRANGE_WEDGE, 18, 0.01 },
  { "Bezier hexahedron of order 2", VTK_BEZIER_HEXAHEDRON, 27, 0.005 },
  { "Bezier wedge of order 2", VTK_BEZIER_WEDGE, 18, 0.005 } };

/**
 * A cell in about [-0.5, 0.7]^3, whose points are displaced at random by up to `displacement` along
 * each axis, with the values of a cubic field at its points.
 */
Grid MakeCell(const CellCase& shape, double displacement, unsigned int seed);

/**
 * n^3 cubes in [-1, 1]^3 with random scalars, whose inner points are moved at random. Each column
 * of cubes along y has one type of cells: hexahedra, pairs of wedges, or six pyramids per cube;
 * linear ones or those of second order.
 */
Grid MakeMixedBlock(int n, bool quadratic, unsigned int seed);

}
