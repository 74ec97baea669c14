// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelMeshes.h"

#include "Volume/Mesh/CellPassages.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <gtest/gtest.h>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/**
 * Expects each passage to have the cell's link, and as the next vertex the only one of the
 * neighbour that the cell does not have. Returns the number of passages to inactive cells.
 */
int ExpectPassagesOf(const TetrahedralMesh& mesh, const std::vector<CellPassages>& passages)
{
  const auto& cells = mesh.GetCells();
  EXPECT_EQ(passages.size(), cells.size());
  int marked = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    const auto& own = cells[c].Vertices;
    for (std::size_t face = 0; face < 4; ++face)
    {
      const CellPassage& passage = passages[c].Of[face];
      EXPECT_EQ(passage.Link, cells[c].Links[face]);
      const bool isMarked = passage.Link < TetrahedralMesh::NoNeighbor;
      marked += isMarked;
      const std::int32_t link = isMarked ? TetrahedralMesh::MarkedLink(passage.Link) : passage.Link;
      if (link == TetrahedralMesh::NoNeighbor)
      {
        EXPECT_EQ(passage.Opposite, own[face]);
        continue;
      }
      const auto& theirs = cells[static_cast<std::size_t>(link / 4)].Vertices;
      const auto other = std::find_if(theirs.begin(), theirs.end(),
        [&own](std::int32_t vertex)
        { return std::find(own.begin(), own.end(), vertex) == own.end(); });
      EXPECT_EQ(passage.Opposite, *other);
    }
  }
  return marked;
}

}

TEST(CellPassages, LeadToTheVertexBehindEachFace)
{
  const MeshArrays arrays = KuhnGrid(5);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  std::vector<CellPassages> passages = FindPassages(mesh);
  EXPECT_EQ(ExpectPassagesOf(mesh, passages), 0);
  std::vector<std::uint8_t> active(static_cast<std::size_t>(mesh.GetNumberOfCells()));
  for (std::size_t c = 0; c < active.size(); ++c)
  {
    active[c] = c % 7 == 0 || c > active.size() / 2 ? 1 : 0;
  }
  ASSERT_TRUE(mesh.SetActiveCells(active, 0));
  EXPECT_GT(ExpectPassagesOf(mesh, FindPassages(mesh)), 100);
  UpdateLinks(mesh, passages, SerialLoop);
  EXPECT_GT(ExpectPassagesOf(mesh, passages), 100);
}

TEST(CellPassages, FitIntoLinesOfTheCache)
{
  const MeshArrays arrays = KuhnGrid(3);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  const std::vector<CellPassages> passages = FindPassages(mesh);
  for (const CellPassages& cell : passages)
  {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&cell) % sizeof(CellPassages), 0u);
  }
}
