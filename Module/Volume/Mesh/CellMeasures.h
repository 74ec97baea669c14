// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/CellLanes.h"

namespace meniscus
{

/** Edges and volumes of consecutive cells, in units of positions. */
struct CellMeasures : CellLanes
{
  /** Squares of the lengths of the longest and the shortest edge. */
  double Longest[Capacity] = {};
  double Shortest[Capacity] = {};
  /** SignedVolume() to the last bit. */
  double Volumes[Capacity] = {};
};

/** Computes the measures of the loaded cells. */
void MeasureLanes(InstructionSet set, CellMeasures& cells);

}
