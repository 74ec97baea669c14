// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedCellTable.h"

#include "Volume/Graded/GradedCell.h"
#include "Volume/Graded/GradedPassage.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace meniscus
{
namespace
{

/** Sum of the sizes of a vector's components. */
double SizeOf(const glm::dvec3& v)
{
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

GradedCellRow MakeRow(
  const GradedCell& cell, const TetrahedralMesh::Cell& ofMesh, const glm::dvec3& first)
{
  using Row = GradedCellRow;
  GradedCellRow row{};
  row.Links = ofMesh.Links;
  double* const values = row.Values;
  double norm = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    values[Row::Gradients + i] = cell.IsFlat || cell.IsInverted
      ? std::numeric_limits<double>::quiet_NaN()
      : cell.Gradients[i / 3 + 1][i % 3];
  }
  glm::dvec3 force = cell.GetForce({ 1.0, 0.0, 0.0, 0.0 });
  if (cell.IsCurved && !cell.IsFlat)
  {
    const glm::dmat3 derivative = cell.GetForceDerivative();
    force -= derivative * first;
    const double entries[6] = { derivative[0][0], derivative[1][1], derivative[2][2],
      derivative[1][0], derivative[2][0], derivative[2][1] };
    std::copy(std::begin(entries), std::end(entries), values + Row::Derivative);
    for (int axis = 0; axis < 3; ++axis)
    {
      norm = std::max(norm, SizeOf(derivative[axis]));
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    values[Row::Force + axis] = force[axis];
  }
  const GradedStepBounds bounds(cell, norm);
  // As the first number of a pair it grows, by less than this shrinks it.
  constexpr double shrink = 1.0 - 0x1p-18;
  values[Row::Times] = Row::PackUpwards(shrink * bounds.LongestTime, bounds.ShortTime);
  values[Row::HigherTerms] = Row::PackUpwards(bounds.Linear, bounds.Cubic);
  return row;
}

}

//------------------------------------------------------------------------------
GradedStepBounds::GradedStepBounds(const GradedCell& cell, double norm)
{
  double gradient = 0.0;
  std::array<glm::dvec3, 4> forces;
  double force = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    std::array<double, 4> weights{};
    weights[i] = 1.0;
    forces[i] = cell.GetForce(weights);
    force = std::max(force, glm::length(forces[i]));
    gradient = std::max(gradient, glm::length(cell.Gradients[i]));
  }
  double term = 0.0;
  for (const double ofEdge : cell.Edges)
  {
    term = std::max(term, std::abs(ofEdge));
  }
  // The products of two different weights have a sum of at most 3 / 8. n^2 is at least half the
  // linear one (QuadraticIndex.h).
  const auto squares = std::minmax_element(cell.SquaredIndices.begin(), cell.SquaredIndices.end());
  const double least = *squares.first;
  const double slowest = std::sqrt(std::max(0.5 * least, least - 0.375 * term));
  const double fastest = std::sqrt(*squares.second + 0.375 * term);

  // No edge is longer than twice the longest of those at a vertex.
  const double size = std::sqrt(cell.SquaredSize);
  this->LongestTime = 4.0 * size / slowest;
  // The sixth term is (N t^2)^2 / 360 of the second, the seventh (N t^2)^3 / 5040 of the first.
  const auto rest = [norm, force, slowest](double t)
  {
    const double exponent = norm * t * t;
    return exponent * exponent * (exponent + 7.0 * force * t / slowest) / 5040.0;
  };
  const double longestRest = rest(this->LongestTime);
  if (longestRest > LargestRest)
  {
    // Between the fifth and the sixth power of the time.
    this->LongestTime *= std::pow(LargestRest / longestRest, 1.0 / 5.0);
    this->LongestTime *= std::pow(LargestRest / rest(this->LongestTime), 1.0 / 6.0);
  }

  // n is at least the slowest, and the force is linear: it is at least its least component along
  // the mean one.
  const glm::dvec3 mean = 0.25 * ((forces[0] + forces[1]) + (forces[2] + forces[3]));
  double along = glm::dot(mean, mean);
  for (const glm::dvec3& ofVertex : forces)
  {
    along = std::min(along, glm::dot(mean, ofVertex));
  }
  const double weakest = along > 0.0 ? along / glm::length(mean) : 0.0;
  this->ShortTime = std::min(GradedPassage::LongestShare * size / slowest,
    std::sqrt(8.0 * GradedPassage::GlideHeight / weakest));

  const double rate = gradient * (fastest + force * this->LongestTime);
  this->Linear = 2.0 * GradedPassage::Rounding * rate;
  this->Cubic = 0.4 * norm * rate;
}

//------------------------------------------------------------------------------
double GradedCellRow::PackUpwards(double first, double second)
{
  constexpr int half = 32;
  const auto upperOf = [](double value)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    constexpr std::uint64_t lower = (std::uint64_t{ 1 } << half) - 1;
    return (bits + lower) >> half;
  };
  const std::uint64_t bits = upperOf(first) << half | upperOf(second);
  double packed = 0.0;
  std::memcpy(&packed, &bits, sizeof(packed));
  return packed;
}

//------------------------------------------------------------------------------
void GradedCellTable::Build(const TetrahedralMesh& mesh, const std::vector<double>& squaredIndices,
  const std::vector<EdgeTerms>* terms, const RangeLoop& loop)
{
  const auto& cells = mesh.GetCells();
  this->Rows.assign(cells.size(), GradedCellRow{});
  ForEachItem(cells.size(), loop,
    [&](std::size_t c)
    {
      const auto number = static_cast<std::int64_t>(c);
      if (mesh.IsActiveCell(number))
      {
        this->Rows[c] = MakeRow(MakeGradedCell(mesh, squaredIndices, terms, number), cells[c],
          mesh.GetPosition(cells[c].Vertices[0]));
      }
    });
}

}
