// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/InputContent.h"
#include "Volume/Mesh/PointBox.h"

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

private:
  ContentWatch CellWatch;
  ContentWatch PointWatch;
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
