// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

#include <cstdint>

namespace meniscus
{

class TetrahedralMesh;

/**
 * Number of active cells that are inside out: they lie on the same side of their faces as their
 * neighbours, with which they overlap. Cells without a volume, to within rounding, do not count.
 */
std::int64_t CountInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

/**
 * True if a cell is inverted by more than rounding. A ray may then return to a cell it has left,
 * and only a walk from the boundary is certain to end on the boundary.
 */
bool HasInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

}
