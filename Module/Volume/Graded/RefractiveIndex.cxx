// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/RefractiveIndex.h"

#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Square of an index, NaN if it is unusable. */
double SquareOf(double index, IndexFaults& faults)
{
  const double square = index * index;
  if (!std::isfinite(square))
  {
    ++faults.NotFinite;
    return std::numeric_limits<double>::quiet_NaN();
  }
  // A square that is not normal has lost the precision of the index.
  if (!(index > 0.0) || square < std::numeric_limits<double>::min())
  {
    ++faults.NotPositive;
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (index < 1.0)
  {
    ++faults.BelowOne;
  }
  return square;
}

}

//------------------------------------------------------------------------------
std::vector<double> SquareIndices(const std::vector<double>& indices, IndexFaults& faults)
{
  faults = IndexFaults();
  std::vector<double> squares;
  squares.reserve(indices.size());
  for (const double index : indices)
  {
    squares.push_back(SquareOf(index, faults));
  }
  return squares;
}

//------------------------------------------------------------------------------
std::vector<double> SquareIndicesOfGas(
  const std::vector<double>& densities, double constant, IndexFaults& faults)
{
  faults = IndexFaults();
  std::vector<double> squares;
  squares.reserve(densities.size());
  for (const double density : densities)
  {
    // There is no negative density, even if its index is positive.
    squares.push_back(SquareOf(density < 0.0 ? -1.0 : 1.0 + constant * density, faults));
  }
  return squares;
}

//------------------------------------------------------------------------------
std::int64_t ActivateCellsWithIndex(
  TetrahedralMesh& mesh, const std::vector<double>& squaredIndices, const RangeLoop& loop)
{
  const auto& cells = mesh.GetCells();
  std::vector<std::uint8_t> active(cells.size(), 1);
  std::int64_t unknown = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    for (const std::int32_t vertex : cells[c].Vertices)
    {
      if (std::isnan(squaredIndices[static_cast<std::size_t>(vertex)]))
      {
        active[c] = 0;
      }
    }
    unknown += active[c] == 0 ? 1 : 0;
  }
  mesh.SetActiveCells(active, unknown, loop);
  return unknown;
}

}
