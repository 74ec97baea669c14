// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/ScalarGradients.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/CellLanes.h"

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

/** Gradient of a cell times its weight. */
struct WeightedGradient
{
  /** Three components, and six times the volume; all 0 if the cell has no gradient. */
  double Values[4] = { 0.0, 0.0, 0.0, 0.0 };

  double GetWeight() const { return this->Values[3]; }
  void Add(const WeightedGradient& other)
  {
    for (int i = 0; i < 4; ++i)
    {
      this->Values[i] += other.Values[i];
    }
  }
};

struct GradientLanes : CellLanes
{
  /** By vertex and cell. */
  double Scalars[4][Capacity] = {};
  /** WeightedGradient::Values of each cell. */
  double Weighted[4][Capacity] = {};

  void Get(WeightedGradient* gradients) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      gradients[i] = { { this->Weighted[0][i], this->Weighted[1][i], this->Weighted[2][i],
        this->Weighted[3][i] } };
    }
  }
};

/** Loop body for one cell. */
struct GradientKernel
{
  double Scale;

  /** Change of the scalar from the first vertex; NaN if it is not known. */
  double ChangeTo(const GradientLanes& lanes, int k, int i) const
  {
    const double to = lanes.Scalars[k][i];
    const double from = lanes.Scalars[0][i];
    const double change =
      std::min(std::max((to - from) * this->Scale, -LargestChange), LargestChange);
    // The difference of infinite numbers is no number.
    const bool isKnown = ((to - to) + (from - from)) == 0.0;
    return isKnown ? change : std::numeric_limits<double>::quiet_NaN();
  }

  void operator()(GradientLanes& lanes, int i) const
  {
    constexpr double unit = TetrahedralMesh::PositionUnit;
    double edges[3][3];
    for (int k = 0; k < 3; ++k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edges[k][axis] = unit * lanes.GetEdge(0, k + 1, axis, i);
      }
    }
    const double changes[3] = { this->ChangeTo(lanes, 1, i), this->ChangeTo(lanes, 2, i),
      this->ChangeTo(lanes, 3, i) };
    double sum[3];
    double volume = 0.0;
    for (int x = 0; x < 3; ++x)
    {
      const int y = (x + 1) % 3;
      const int z = (x + 2) % 3;
      const auto cross = [&](int p, int q)
      { return edges[p][y] * edges[q][z] - edges[q][y] * edges[p][z]; };
      const double opposite = cross(1, 2);
      sum[x] = changes[0] * opposite + changes[1] * cross(2, 0) + changes[2] * cross(0, 1);
      volume = volume + edges[0][x] * opposite;
    }
    const double total = sum[0] + sum[1] + sum[2];
    const bool isKnown = (volume != 0.0) & (total == total);
    for (int x = 0; x < 3; ++x)
    {
      const double turned = volume > 0.0 ? sum[x] : -sum[x];
      lanes.Weighted[x][i] = isKnown ? turned : 0.0;
    }
    lanes.Weighted[3][i] = isKnown ? std::abs(volume) : 0.0;
  }
};

/** Weighted gradients of ranges of cells. */
class WeightedGradients
{
public:
  WeightedGradients(const TetrahedralMesh& mesh, const std::vector<double>& scalars, double scale)
    : Mesh(mesh)
    , Scalars(scalars)
    , Kernel{ scale }
  {
  }

  /** Writes the gradients of the cells [first, last). */
  void Compute(std::size_t first, std::size_t last, WeightedGradient* gradients) const
  {
    const auto& cells = this->Mesh.GetCells();
    GradientLanes lanes;
    ForEachGroup(this->Mesh, first, last, lanes,
      [&](GradientLanes& group, std::size_t begin)
      {
        for (int i = 0; i < group.Count; ++i)
        {
          for (int k = 0; k < 4; ++k)
          {
            group.Scalars[k][i] =
              this->Scalars[static_cast<std::size_t>(cells[begin + i].Vertices[k])];
          }
        }
        RunLanes(this->Kernel, this->Set, group);
        group.Get(gradients + (begin - first));
      });
  }

private:
  const TetrahedralMesh& Mesh;
  const std::vector<double>& Scalars;
  GradientKernel Kernel;
  InstructionSet Set = BestInstructionSet();
};

/** The gradient in single precision. */
glm::vec3 GradientOf(const WeightedGradient& weighted)
{
  if (!(weighted.GetWeight() > 0.0))
  {
    return glm::vec3(0.0f);
  }
  const double* sum = weighted.Values;
  const glm::dvec3 gradient = glm::dvec3(sum[0], sum[1], sum[2]) / weighted.GetWeight();
  const glm::dvec3 size = glm::abs(gradient);
  const double largest = std::max(std::max(size.x, size.y), size.z);
  // The length is at most sqrt(3) times the largest component.
  if (!(2.0 * largest > LongestGradient))
  {
    return glm::vec3(gradient);
  }
  // The vector is divided by its largest component first: squares of large components would
  // overflow.
  const double length = largest * glm::length(gradient / largest);
  return glm::vec3(length > LongestGradient ? gradient * (LongestGradient / length) : gradient);
}

}

//------------------------------------------------------------------------------
std::vector<glm::vec3> ComputeCellGradients(const TetrahedralMesh& mesh,
  const std::vector<double>& scalars, double scale, const RangeLoop& loop)
{
  const WeightedGradients weighted(mesh, scalars, scale);
  std::vector<glm::vec3> gradients(mesh.GetCells().size());
  ForEachBlock(gradients.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      std::vector<WeightedGradient> ofBlock(last - first);
      weighted.Compute(first, last, ofBlock.data());
      std::transform(ofBlock.begin(), ofBlock.end(), gradients.begin() + first, GradientOf);
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
  // Parts of ten microseconds of work, and a chunk that stays in a cache.
  constexpr std::size_t part = 2048;
  constexpr std::size_t chunk = 16 * part;
  const auto& cells = mesh.GetCells();
  const WeightedGradients ofCells(mesh, scalars, scale);
  std::vector<WeightedGradient> sums(static_cast<std::size_t>(mesh.GetNumberOfVertices()));
  std::vector<WeightedGradient> weighted(std::min(chunk, cells.size()));
  for (std::size_t begin = 0; begin < cells.size(); begin += chunk)
  {
    const std::size_t count = std::min(chunk, cells.size() - begin);
    loop((count + part - 1) / part,
      [&](std::size_t first, std::size_t last)
      {
        const std::size_t from = first * part;
        const std::size_t to = std::min(last * part, count);
        ofCells.Compute(begin + from, begin + to, weighted.data() + from);
      });
    for (std::size_t i = 0; i < count; ++i)
    {
      for (const std::int32_t vertex : cells[begin + i].Vertices)
      {
        sums[static_cast<std::size_t>(vertex)].Add(weighted[i]);
      }
    }
  }
  std::vector<glm::vec3> gradients(sums.size());
  ForEachInBlocks(sums.size(), loop, [&](std::size_t v) { gradients[v] = GradientOf(sums[v]); });
  return gradients;
}

}
