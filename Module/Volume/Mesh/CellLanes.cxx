// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/CellLanes.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void CellLanes::Load(
  const std::vector<glm::ivec3>& positions, const TetrahedralMesh::Cell* cells, int count)
{
  this->Count = count;
  for (int i = 0; i < count; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      const glm::ivec3& place = positions[static_cast<std::size_t>(cells[i].Vertices[k])];
      this->Places[k][0][i] = place.x;
      this->Places[k][1][i] = place.y;
      this->Places[k][2][i] = place.z;
    }
  }
}

}
