// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

namespace meniscus
{

class TetrahedralMesh;

/** Length of the longest edge of a cell, in units of the mesh's radius; 0 without cells. */
double ComputeLongestEdge(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

}
