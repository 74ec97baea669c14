// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/CellPassages.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <cstddef>

namespace meniscus
{

//------------------------------------------------------------------------------
std::vector<CellPassages> FindPassages(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  const std::vector<TetrahedralMesh::Cell>& cells = mesh.GetCells();
  std::vector<CellPassages> passages(cells.size());
  ForEachInBlocks(cells.size(), loop,
    [&](std::size_t c)
    {
      for (std::size_t face = 0; face < 4; ++face)
      {
        const std::int32_t link = cells[c].Links[face];
        const bool isMarked = link < TetrahedralMesh::NoNeighbor;
        const std::int32_t there = isMarked ? TetrahedralMesh::MarkedLink(link) : link;
        passages[c].Of[face] = { link,
          there == TetrahedralMesh::NoNeighbor
            ? cells[c].Vertices[face]
            : cells[static_cast<std::size_t>(there / 4)].Vertices[there % 4] };
      }
    });
  return passages;
}

//------------------------------------------------------------------------------
void UpdateLinks(
  const TetrahedralMesh& mesh, std::vector<CellPassages>& passages, const RangeLoop& loop)
{
  const std::vector<TetrahedralMesh::Cell>& cells = mesh.GetCells();
  ForEachInBlocks(cells.size(), loop,
    [&](std::size_t c)
    {
      for (std::size_t face = 0; face < 4; ++face)
      {
        passages[c].Of[face].Link = cells[c].Links[face];
      }
    });
}

}
