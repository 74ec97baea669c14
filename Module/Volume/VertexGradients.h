// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_VertexGradients_h
#define meniscus_Volume_VertexGradients_h

#include "Volume/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus
{

/**
 * Gradient of a scalar at the vertices: the mean of the gradients of the cells around, weighted by
 * their volumes. Exact for a linear scalar. In units of the scalar per mesh radius. Cells without
 * volume or with a scalar that is not finite do not count; a vertex of such cells only has 0.
 * @param scalars  one per vertex.
 */
std::vector<glm::vec3> ComputeVertexGradients(
  const TetrahedralMesh& mesh, const std::vector<float>& scalars);

}

#endif
