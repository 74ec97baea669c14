// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/InvertedCells.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/geometric.hpp>

#include <atomic>
#include <cmath>
#include <numeric>
#include <vector>

namespace meniscus
{
namespace
{

/** True if a cell is inside out by more than the rounding of the determinant of its edges. */
template <typename RoundingOf>
bool IsInverted(const TetrahedralMesh& mesh, std::size_t cell, const RoundingOf& roundingOf)
{
  const auto& vertices = mesh.GetCells()[cell].Vertices;
  const glm::dvec3 origin = mesh.GetPosition(vertices[0]);
  const glm::dvec3 a = mesh.GetPosition(vertices[1]) - origin;
  const glm::dvec3 b = mesh.GetPosition(vertices[2]) - origin;
  const glm::dvec3 c = mesh.GetPosition(vertices[3]) - origin;
  const double volume = glm::dot(glm::cross(a, b), c);
  const double sign = mesh.IsPositivelyOriented(static_cast<std::int64_t>(cell)) ? 1.0 : -1.0;
  return sign * volume < -roundingOf(glm::length(a), glm::length(b), glm::length(c));
}

}

//------------------------------------------------------------------------------
std::int64_t CountInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  // Three products of three factors each, with the sums of a cross product and a dot product.
  constexpr double rounding = 0x1p-48;
  const auto roundingOf = [](double a, double b, double c) { return rounding * a * b * c; };
  const std::size_t cells = mesh.GetCells().size();
  std::vector<std::int64_t> found(NumberOfBlocks(cells), 0);
  ForEachBlock(cells, loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        found[block] +=
          mesh.IsActiveCell(static_cast<std::int64_t>(c)) && IsInverted(mesh, c, roundingOf);
      }
    });
  return std::accumulate(found.begin(), found.end(), std::int64_t{ 0 });
}

//------------------------------------------------------------------------------
bool HasInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  // Vertices are rounded by half a unit per axis, so the error of an edge is up to sqrt(3) units,
  // and the error of the volume is that times the area of each pair of edges.
  const double ofEdge = std::sqrt(3.0) * TetrahedralMesh::PositionUnit;
  const auto roundingOf = [ofEdge](double a, double b, double c)
  { return ofEdge * (a * b + b * c + c * a); };
  std::atomic<bool> found{ false };
  ForEachInBlocks(mesh.GetCells().size(), loop,
    [&](std::size_t c)
    {
      if (!found && IsInverted(mesh, c, roundingOf))
      {
        found = true;
      }
    });
  return found;
}

}
