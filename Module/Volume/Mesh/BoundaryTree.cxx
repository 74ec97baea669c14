// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/BoundaryTree.h"

#include "Common/MedianSplit.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

struct BoundaryTree::Item
{
  glm::vec3 Lower;
  glm::vec3 Upper;
  /** Number of the face in the mesh's boundary. */
  std::int32_t Index;
};

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

/**
 * Smallest float half extent for which the box around `center` contains [lower, upper] in exact
 * arithmetic.
 */
float HalfExtent(float center, float lower, float upper)
{
  const double half =
    std::max(static_cast<double>(upper) - center, static_cast<double>(center) - lower);
  const float rounded = static_cast<float>(half);
  return rounded < half ? std::nextafter(rounded, Infinity) : rounded;
}

}

//------------------------------------------------------------------------------
void BoundaryTree::Build(const TetrahedralMesh& mesh)
{
  this->Nodes.clear();
  this->Faces.clear();
  const auto& boundary = mesh.GetBoundary();
  if (boundary.empty())
  {
    return;
  }
  std::vector<Item> items(boundary.size());
  for (std::size_t f = 0; f < boundary.size(); ++f)
  {
    const glm::vec3 a(mesh.GetPosition(boundary[f].Vertices[0]));
    const glm::vec3 b(mesh.GetPosition(boundary[f].Vertices[1]));
    const glm::vec3 c(mesh.GetPosition(boundary[f].Vertices[2]));
    items[f] = { glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)),
      static_cast<std::int32_t>(f) };
  }
  this->Nodes.reserve(2 * items.size() - 1);
  this->Faces.reserve(items.size());
  this->BuildSubtree(mesh, items, 0, items.size());
}

//------------------------------------------------------------------------------
void BoundaryTree::BuildSubtree(
  const TetrahedralMesh& mesh, std::vector<Item>& items, std::size_t first, std::size_t last)
{
  glm::vec3 lower(Infinity);
  glm::vec3 upper(-Infinity);
  for (std::size_t i = first; i < last; ++i)
  {
    lower = glm::min(lower, items[i].Lower);
    upper = glm::max(upper, items[i].Upper);
  }
  const std::size_t node = this->Nodes.size();
  const glm::vec3 center = 0.5f * (lower + upper);
  glm::vec3 half;
  for (int axis = 0; axis < 3; ++axis)
  {
    half[axis] = HalfExtent(center[axis], lower[axis], upper[axis]);
  }
  this->Nodes.push_back({ center, half, 0, -1 });

  if (last - first == 1)
  {
    this->Nodes[node].Face = static_cast<std::int32_t>(this->Faces.size());
    this->Faces.push_back(mesh.GetBoundary()[items[first].Index]);
  }
  else
  {
    const std::size_t middle = SplitAtMedian(items, first, last);
    this->BuildSubtree(mesh, items, first, middle);
    this->BuildSubtree(mesh, items, middle, last);
  }
  this->Nodes[node].Skip = static_cast<std::int32_t>(this->Nodes.size());
}

}
