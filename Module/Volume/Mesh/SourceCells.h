// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Input cell of each cell of a mesh, as TetrahedralMesh::GetSourceCells(), for a mesh that was
 * built without it. Cells are recognised by their four points.
 * @param input the arrays that the mesh was built from.
 * @return one index per cell; -1 for cells that `input` does not have.
 */
std::vector<std::int32_t> FindSourceCells(
  const TetrahedralMesh& mesh, const TetrahedraView& input, const RangeLoop& loop = SerialLoop);

}
