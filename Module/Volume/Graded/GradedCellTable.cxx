// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedCellTable.h"

#include "Volume/Graded/GradedCell.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
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
  double largestGradient = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    largestGradient = std::max(largestGradient, SizeOf(cell.Gradients[i]));
  }
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
  values[Row::SquaredSize] = cell.SquaredSize;
  values[Row::NormAndLargestGradient] = Row::PackUpwards(norm, largestGradient);
  return row;
}

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
  loop(cells.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t c = begin; c < end; ++c)
      {
        const auto number = static_cast<std::int64_t>(c);
        if (mesh.IsActiveCell(number))
        {
          this->Rows[c] = MakeRow(MakeGradedCell(mesh, squaredIndices, terms, number), cells[c],
            mesh.GetPosition(cells[c].Vertices[0]));
        }
      }
    });
}

}
