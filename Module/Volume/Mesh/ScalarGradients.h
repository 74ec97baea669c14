// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Gradients of a scalar in a tetrahedral mesh, computed in double precision from the scalars as the
 * user gives them: where the scalars of a cell differ little, rounding them to normalised floats
 * turns the gradient. Scalars that are equal as given have no gradient: it is 0.
 */
#ifndef meniscus_Volume_Mesh_ScalarGradients_h
#define meniscus_Volume_Mesh_ScalarGradients_h

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus
{

/**
 * Gradient per cell, in units of scalar times scale per mesh radius; no longer than 1e18, whose
 * square is finite in single precision. 0 in a cell without volume or with a scalar that is not
 * finite.
 * @param scalars  one per vertex.
 */
std::vector<glm::vec3> ComputeCellGradients(const TetrahedralMesh& mesh,
  const std::vector<double>& scalars, double scale, const RangeLoop& loop = SerialLoop);

/**
 * The same at the vertices: the mean of the gradients of the cells around, weighted by their
 * volumes. Exact for a linear scalar. Cells without volume or with a scalar that is not finite do
 * not count; a vertex of such cells only has 0.
 */
std::vector<glm::vec3> ComputeVertexGradients(
  const TetrahedralMesh& mesh, const std::vector<double>& scalars, double scale);

}

#endif
