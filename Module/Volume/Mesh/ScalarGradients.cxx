// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/ScalarGradients.h"

#include "Common/BlockLoop.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Longest gradient. Its square is below the largest float, 3.4e38. */
constexpr double LongestGradient = 1.0e+18;
/** Largest change of a scalar. Its products with areas and volumes stay finite. */
constexpr double LargestChange = 1.0e+150;

/** Gradient of a cell times its signed volume. */
struct WeightedGradient
{
  glm::dvec3 Sum;
  /** Six times the volume. */
  double Volume;

  /** True if the cell has a gradient. */
  bool IsKnown() const
  {
    return this->Volume != 0.0 && !std::isnan(this->Sum.x + this->Sum.y + this->Sum.z);
  }
};

WeightedGradient GradientOf(const TetrahedralMesh& mesh, const TetrahedralMesh::Cell& cell,
  const std::vector<double>& scalars, double scale)
{
  const auto& v = cell.Vertices;
  const glm::dvec3 origin = mesh.GetPosition(v[0]);
  const glm::dvec3 a = mesh.GetPosition(v[1]) - origin;
  const glm::dvec3 b = mesh.GetPosition(v[2]) - origin;
  const glm::dvec3 c = mesh.GetPosition(v[3]) - origin;
  const auto change = [&](int i)
  {
    const double to = scalars[v[i]];
    const double from = scalars[v[0]];
    return std::isfinite(to) && std::isfinite(from)
      ? std::clamp((to - from) * scale, -LargestChange, LargestChange)
      : std::numeric_limits<double>::quiet_NaN();
  };
  const glm::dvec3 bc = glm::cross(b, c);
  return { change(1) * bc + change(2) * glm::cross(c, a) + change(3) * glm::cross(a, b),
    glm::dot(a, bc) };
}

glm::vec3 Rounded(const glm::dvec3& gradient)
{
  const glm::dvec3 size = glm::abs(gradient);
  const double largest = std::max({ size.x, size.y, size.z });
  // The vector is divided by its largest component first: squares of large components would
  // overflow.
  const double length = largest > 0.0 ? largest * glm::length(gradient / largest) : 0.0;
  return glm::vec3(length > LongestGradient ? gradient * (LongestGradient / length) : gradient);
}

}

//------------------------------------------------------------------------------
std::vector<glm::vec3> ComputeCellGradients(const TetrahedralMesh& mesh,
  const std::vector<double>& scalars, double scale, const RangeLoop& loop)
{
  const auto& cells = mesh.GetCells();
  std::vector<glm::vec3> gradients(cells.size());
  ForEachBlock(cells.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const WeightedGradient weighted = GradientOf(mesh, cells[i], scalars, scale);
        gradients[i] =
          weighted.IsKnown() ? Rounded(weighted.Sum / weighted.Volume) : glm::vec3(0.0f);
      }
    });
  return gradients;
}

//------------------------------------------------------------------------------
/**
 * Cells are evaluated in parallel, a chunk at a time, and added to their vertices in order, so that
 * the sums do not depend on the loop.
 */
std::vector<glm::vec3> ComputeVertexGradients(const TetrahedralMesh& mesh,
  const std::vector<double>& scalars, double scale, const RangeLoop& loop)
{
  constexpr std::size_t chunk = 16 * BlockSize;
  const auto& cells = mesh.GetCells();
  const auto size = static_cast<std::size_t>(mesh.GetNumberOfVertices());
  std::vector<glm::dvec3> sums(size, glm::dvec3(0.0));
  std::vector<double> volumes(size, 0.0);
  std::vector<WeightedGradient> weighted(std::min(chunk, cells.size()));
  for (std::size_t begin = 0; begin < cells.size(); begin += chunk)
  {
    const std::size_t count = std::min(chunk, cells.size() - begin);
    ForEachBlock(count, loop,
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          weighted[i] = GradientOf(mesh, cells[begin + i], scalars, scale);
        }
      });
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!weighted[i].IsKnown())
      {
        continue;
      }
      for (const std::int32_t vertex : cells[begin + i].Vertices)
      {
        sums[vertex] += weighted[i].Volume > 0.0 ? weighted[i].Sum : -weighted[i].Sum;
        volumes[vertex] += std::abs(weighted[i].Volume);
      }
    }
  }
  std::vector<glm::vec3> gradients(size, glm::vec3(0.0f));
  ForEachBlock(size, loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        if (volumes[i] > 0.0)
        {
          gradients[i] = Rounded(sums[i] / volumes[i]);
        }
      }
    });
  return gradients;
}

}
