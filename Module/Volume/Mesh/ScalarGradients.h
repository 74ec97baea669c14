// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Gradients of a scalar in a tetrahedral mesh, computed in double precision from the user's
 * scalars: where the scalars of a cell differ little, rounding them to normalised floats would
 * change the direction of the gradient. Equal scalars have the gradient 0.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus
{

/**
 * Gradient per cell, in units of scalar times scale per mesh radius. Its length is at most 1e18,
 * the square of which is finite in single precision. It is 0 in a cell without volume or with a
 * scalar that is not finite.
 * @param scalars one per vertex.
 */
std::vector<glm::vec3> ComputeCellGradients(const TetrahedralMesh& mesh,
  const std::vector<double>& scalars, double scale, const RangeLoop& loop = SerialLoop);

/**
 * Gradient per vertex: the mean of the gradients of the adjacent cells, weighted by their volumes.
 * It is exact for a linear scalar. Cells without volume or with a scalar that is not finite are
 * ignored; a vertex without other cells has the gradient 0.
 */
std::vector<glm::vec3> ComputeVertexGradients(const TetrahedralMesh& mesh,
  const std::vector<double>& scalars, double scale, const RangeLoop& loop = SerialLoop);

}
