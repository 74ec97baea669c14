// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/LaneLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Corners of consecutive cells as arrays, for loops over lanes (LaneLoop.h). */
struct CellLanes
{
  static constexpr int Capacity = 64;
  static_assert(Capacity % LaneGroup == 0, "whole groups");

  int Count = 0;
  /** Fixed positions of the ascending vertices: by vertex, axis and cell. */
  std::int32_t Places[4][3][Capacity] = {};

  void Load(
    const std::vector<glm::ivec3>& positions, const TetrahedralMesh::Cell* cells, int count);

  /** Component of the edge from a cell's vertex to another one, exact. */
  double GetEdge(int from, int to, int axis, int i) const
  {
    return double(this->Places[to][axis][i]) - double(this->Places[from][axis][i]);
  }
};

/** Calls body(lanes, first) for the cells [first, first + lanes.Count) of a range, once each. */
template <class Lanes, class Body>
void ForEachGroup(
  const TetrahedralMesh& mesh, std::size_t first, std::size_t last, Lanes& lanes, const Body& body)
{
  constexpr std::size_t most = CellLanes::Capacity;
  for (; first < last; first += most)
  {
    const auto count = static_cast<int>(std::min(most, last - first));
    lanes.Load(mesh.GetFixedPositions(), mesh.GetCells().data() + first, count);
    body(lanes, first);
  }
}

}
