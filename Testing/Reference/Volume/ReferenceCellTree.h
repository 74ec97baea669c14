// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus::reference
{

struct Ray
{
  Vector3 Origin{ 0.0, 0.0, 0.0 };
  Vector3 Direction{ 0.0, 0.0, 1.0 };
  double Begin = 0.0;
  double End = 0.0;
};

/** Bounding box tree over the cells of a mesh that have a volume. */
class ReferenceCellTree
{
public:
  explicit ReferenceCellTree(const ReferenceMesh& mesh);

  /**
   * Appends every cell with a volume whose box the ray meets (a superset of the cells it crosses).
   */
  void Candidates(const Ray& ray, std::vector<std::int64_t>& cells) const;

private:
  struct Node
  {
    std::array<double, 6> Box; // low x, y, z, high x, y, z
    std::int32_t First;        // leaf: first of Order; inner: index of the right child
    std::int32_t Count;        // leaf: cells; inner: 0, the left child follows the node
  };

  void Build(const ReferenceMesh& mesh, const std::vector<Vector3>& centroids, std::int32_t begin,
    std::int32_t end);
  std::array<double, 6> BoxOf(
    const ReferenceMesh& mesh, std::int32_t begin, std::int32_t end) const;

  std::vector<Node> Nodes;
  std::vector<std::int64_t> Order;
  double Padding = 0.0;
};

} // namespace meniscus::reference
