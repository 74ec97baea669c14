// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/InputContent.h"
#include "Volume/Mesh/PointBox.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataSet;

namespace meniscus
{

/**
 * Box around the points of the cells that are drawn: cells with a volume that are not left out.
 * Points that no such cell uses do not count. If all cells are flat, the box is theirs.
 */
class DrawnBounds
{
public:
  /**
   * Box of the data sets of an input; empty if they have no such cells. It is kept until their
   * points or cells change.
   */
  const PointBox& Update(const InputBlocks& input, InputDigests& digests);
  /** Times that the box was computed. */
  std::int64_t GetNumberOfBuilds() const { return this->Builds; }

  /** Where the tetrahedra of a data set reach the sides of the box around its points. */
  struct SideCells
  {
    /** Number of points; 0 if cells are not known to be tetrahedra of four different ones. */
    std::size_t Points = 0;
    /** Blocks of cells, each of which has a cell that is not flat at one of the sides. */
    std::vector<std::size_t> Blocks;
  };

private:
  ContentWatch CellWatch;
  ContentWatch PointWatch;
  /** One for each data set. They hold until the cells change. */
  std::vector<SideCells> Sides;
  PointBox Box;
  std::int64_t Builds = 0;
};

/** Warning that a box is too small for VTK's cameras, which do not see it; empty if they do. */
std::string DescribeSmallBox(const PointBox& box);

/**
 * For each point of all data sets, 1 if a cell that is drawn uses it and 0 otherwise.
 * @pre DescribeFault() finds nothing.
 */
std::vector<std::uint8_t> MarkDrawnPoints(const std::vector<vtkDataSet*>& grids);

}
