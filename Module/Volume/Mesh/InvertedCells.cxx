// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/InvertedCells.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/geometric.hpp>

#include <numeric>
#include <vector>

namespace meniscus
{
namespace
{

/**
 * Rounding of the determinant of three edges, relative to the product of their lengths: three
 * products of three factors each, with the sums of a cross product and a dot product.
 */
constexpr double Rounding = 0x1p-48;

bool IsInverted(const TetrahedralMesh& mesh, std::size_t cell)
{
  const auto& vertices = mesh.GetCells()[cell].Vertices;
  const glm::dvec3 origin = mesh.GetPosition(vertices[0]);
  const glm::dvec3 a = mesh.GetPosition(vertices[1]) - origin;
  const glm::dvec3 b = mesh.GetPosition(vertices[2]) - origin;
  const glm::dvec3 c = mesh.GetPosition(vertices[3]) - origin;
  const double volume = glm::dot(glm::cross(a, b), c);
  const double sign = mesh.IsPositivelyOriented(static_cast<std::int64_t>(cell)) ? 1.0 : -1.0;
  return sign * volume < -Rounding * glm::length(a) * glm::length(b) * glm::length(c);
}

}

//------------------------------------------------------------------------------
std::int64_t CountInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  const std::size_t cells = mesh.GetCells().size();
  std::vector<std::int64_t> found(NumberOfBlocks(cells), 0);
  ForEachBlock(cells, loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        found[block] += mesh.IsActiveCell(static_cast<std::int64_t>(c)) && IsInverted(mesh, c);
      }
    });
  return std::accumulate(found.begin(), found.end(), std::int64_t{ 0 });
}

}
