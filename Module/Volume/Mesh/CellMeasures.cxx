// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/CellMeasures.h"

#include <algorithm>

namespace meniscus
{
namespace
{

double SquareOfEdge(const CellMeasures& cells, int from, int to, int i)
{
  const double x = cells.GetEdge(from, to, 0, i);
  const double y = cells.GetEdge(from, to, 1, i);
  const double z = cells.GetEdge(from, to, 2, i);
  return x * x + y * y + z * z;
}

/** Component x of the product of edges from the first vertex, of which y and z follow x. */
double VolumeAlong(const CellMeasures& cells, int x, int y, int z, int i)
{
  const double normal = cells.GetEdge(0, 1, y, i) * cells.GetEdge(0, 2, z, i) -
    cells.GetEdge(0, 2, y, i) * cells.GetEdge(0, 1, z, i);
  return normal * cells.GetEdge(0, 3, x, i);
}

/** Loop body for one cell. Loops within it would not be unrolled before it is vectorised. */
struct MeasureKernel
{
  void operator()(CellMeasures& cells, int i) const
  {
    const double ab = SquareOfEdge(cells, 0, 1, i);
    const double ac = SquareOfEdge(cells, 0, 2, i);
    const double ad = SquareOfEdge(cells, 0, 3, i);
    const double bc = SquareOfEdge(cells, 1, 2, i);
    const double bd = SquareOfEdge(cells, 1, 3, i);
    const double cd = SquareOfEdge(cells, 2, 3, i);
    cells.Longest[i] = std::max(std::max(std::max(ab, ac), std::max(ad, bc)), std::max(bd, cd));
    cells.Shortest[i] = std::min(std::min(std::min(ab, ac), std::min(ad, bc)), std::min(bd, cd));
    cells.Volumes[i] = VolumeAlong(cells, 0, 1, 2, i) + VolumeAlong(cells, 1, 2, 0, i) +
      VolumeAlong(cells, 2, 0, 1, i);
  }
};

}

//------------------------------------------------------------------------------
void MeasureLanes(InstructionSet set, CellMeasures& cells)
{
  RunLanes(MeasureKernel(), set, cells);
}

}
