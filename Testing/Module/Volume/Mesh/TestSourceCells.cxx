// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells of the input that are found after the mesh has been built.
#include "KernelMeshes.h"
#include "TestBasics.h"
#include "Volume/Mesh/SourceCells.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** A mesh whose cells are given again, with cells that are left out in between. */
struct RepeatedMesh
{
  MeshArrays Arrays = KuhnGrid(4);
  std::vector<std::uint8_t> Flags;

  RepeatedMesh()
  {
    Jitter(this->Arrays, 0.02, 5);
    const std::vector<std::int64_t> once = this->Arrays.Cells;
    std::vector<std::int64_t>& cells = this->Arrays.Cells;
    cells.insert(cells.begin(), { 0, 0, 1, 2, -1, 0, 1, 2 });
    // Again from the end, with the points of each cell in reverse order.
    cells.insert(cells.end(), once.rbegin(), once.rend());
    this->Flags.resize(cells.size() / 4, 0);
    for (std::size_t c = 0; c < this->Flags.size(); c += 7)
    {
      this->Flags[c] = 1;
    }
  }
  TetrahedraView View() const
  {
    TetrahedraView view = this->Arrays.View();
    view.CellFlags = this->Flags.data();
    view.LeftOutBits = 1;
    return view;
  }
};

}

//------------------------------------------------------------------------------
TEST(SourceCells, EqualToThoseKeptByTheMesh)
{
  const RepeatedMesh input;
  TetrahedraView view = input.View();
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_TRUE(mesh.GetSourceCells().empty());
  TetrahedraView keeping = view;
  keeping.KeepSourceCells = true;
  TetrahedralMesh kept;
  ASSERT_EQ(kept.Build(keeping), MeshStatus::Ok);
  ASSERT_GT(kept.GetRejectedCells().Duplicate, 100);
  EXPECT_EQ(FindSourceCells(mesh, view), kept.GetSourceCells());
  // 32-bit cells, and cells that are parts of others.
  const std::vector<std::int32_t> shortCells(input.Arrays.Cells.begin(), input.Arrays.Cells.end());
  view.Cells = nullptr;
  view.ShortCells = shortCells.data();
  std::vector<std::int32_t> parts(shortCells.size() / 4);
  std::iota(parts.begin(), parts.end(), 0);
  std::transform(parts.begin(), parts.end(), parts.begin(), [](std::int32_t c) { return c / 6; });
  view.SourceCells = parts.data();
  std::vector<std::int32_t> expected = kept.GetSourceCells();
  std::transform(expected.begin(), expected.end(), expected.begin(),
    [&parts](std::int32_t c) { return parts[static_cast<std::size_t>(c)]; });
  EXPECT_EQ(FindSourceCells(mesh, view), expected);
}

//------------------------------------------------------------------------------
TEST(SourceCells, MissingCells)
{
  const MeshArrays arrays = KuhnGrid(2);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  TetrahedraView none = arrays.View();
  none.NumberOfCells = 0;
  EXPECT_EQ(FindSourceCells(mesh, none),
    std::vector<std::int32_t>(static_cast<std::size_t>(mesh.GetNumberOfCells()), -1));
  EXPECT_TRUE(FindSourceCells(TetrahedralMesh(), arrays.View()).empty());
}
