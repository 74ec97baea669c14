// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/VertexGradients.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
std::vector<glm::vec3> ComputeVertexGradients(
  const TetrahedralMesh& mesh, const std::vector<float>& scalars)
{
  const auto size = static_cast<std::size_t>(mesh.GetNumberOfVertices());
  std::vector<glm::dvec3> sums(size, glm::dvec3(0.0));
  std::vector<double> volumes(size, 0.0);
  for (const TetrahedralMesh::Cell& cell : mesh.GetCells())
  {
    const auto& v = cell.Vertices;
    const glm::dvec3 origin = mesh.GetPosition(v[0]);
    const glm::dvec3 a = mesh.GetPosition(v[1]) - origin;
    const glm::dvec3 b = mesh.GetPosition(v[2]) - origin;
    const glm::dvec3 c = mesh.GetPosition(v[3]) - origin;
    const double scalar = scalars[v[0]];
    const glm::dvec3 bc = glm::cross(b, c);
    const double volume = glm::dot(a, bc);
    // Gradient times signed volume.
    const glm::dvec3 weighted = (scalars[v[1]] - scalar) * bc +
      (scalars[v[2]] - scalar) * glm::cross(c, a) + (scalars[v[3]] - scalar) * glm::cross(a, b);
    if (volume == 0.0 || !std::isfinite(weighted.x + weighted.y + weighted.z))
    {
      continue;
    }
    for (const std::int32_t vertex : v)
    {
      sums[vertex] += volume > 0.0 ? weighted : -weighted;
      volumes[vertex] += std::abs(volume);
    }
  }
  std::vector<glm::vec3> gradients(size, glm::vec3(0.0f));
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    if (volumes[i] > 0.0)
    {
      gradients[i] = glm::vec3(sums[i] / volumes[i]);
    }
  }
  return gradients;
}

}
