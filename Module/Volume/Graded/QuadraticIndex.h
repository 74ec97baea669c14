// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Squared index of refraction as a quadratic function in each cell, from values at the vertices.
 *
 * With barycentric weights w and values f at the vertices, n^2 = sum w_i f_i + sum w_i w_j t_ij
 * over the six edges. The term of an edge depends on nothing but the edge, so that n^2 is
 * continuous across faces.
 *
 * Method:
 * 1. The gradient at each vertex is taken from the quadratic function that fits the values around
 *    the vertex best (Zhang and Naga, "A new finite element gradient recovery method", SIAM J. Sci.
 *    Comput. 26, 2005). It is exact for quadratic fields and off by the square of the cells' size
 *    for smooth ones.
 * 2. Each end of an edge tells a term, by the difference of its gradient along the edge from the
 *    slope of the edge. The smaller one is taken if both have the same sign; otherwise 0, which
 *    leaves n^2 linear. The ends differ in sign at jumps and kinks of the field, which stay as they
 *    are in the cells.
 * 3. No term is larger than the difference of n^2 between either end and the vertices around it.
 * 4. No term is below -min(f_i, f_j), so that n^2 is at least half the linear one.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <array>
#include <vector>

namespace meniscus
{

/** Terms of the edges 01, 02, 03, 12, 13, 23 of a cell. */
using EdgeTerms = std::array<float, 6>;

/**
 * Terms of all cells; 0 in inactive cells and at vertices whose gradient is not determined.
 * @param squaredIndices n^2 of each vertex; not NaN at active cells.
 */
std::vector<EdgeTerms> ComputeEdgeTerms(const TetrahedralMesh& mesh,
  const std::vector<double>& squaredIndices, const RangeLoop& loop = SerialLoop);

}
