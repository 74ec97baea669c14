// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Edges and volumes of cells in lanes, against one cell at a time.
#include "KernelMeshes.h"
#include "TestBasics.h"
#include "Volume/Mesh/CellMeasures.h"
#include "Volume/Mesh/ComponentVolume.h"

using namespace meniscus;
using namespace meniscus::test;

TEST(CellMeasures, AreTheSameWithAllInstructionSets)
{
  MeshArrays arrays = KuhnGrid(7);
  Jitter(arrays, 0.05, 3);
  // A flat cell, whose volume is 0 with or without rounding of products.
  arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2, 3 });
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  const auto& cells = mesh.GetCells();
  for (const InstructionSet set : GetInstructionSets())
  {
    std::size_t measured = 0;
    CellMeasures lanes;
    ForEachGroup(mesh, 0, cells.size(), lanes,
      [&](CellMeasures& group, std::size_t first)
      {
        MeasureLanes(set, group);
        for (int i = 0; i < group.Count; ++i, ++measured)
        {
          const TetrahedralMesh::Cell& cell = cells[first + static_cast<std::size_t>(i)];
          double longest = 0.0;
          double shortest = std::numeric_limits<double>::infinity();
          for (int k = 0; k < 4; ++k)
          {
            for (int j = k + 1; j < 4; ++j)
            {
              const glm::dvec3 edge = glm::dvec3(mesh.GetFixedPositions()[cell.Vertices[j]]) -
                glm::dvec3(mesh.GetFixedPositions()[cell.Vertices[k]]);
              longest = std::max(longest, glm::dot(edge, edge));
              shortest = std::min(shortest, glm::dot(edge, edge));
            }
          }
          ASSERT_EQ(group.Longest[i], longest) << NameOf(set);
          ASSERT_EQ(group.Shortest[i], shortest) << NameOf(set);
          ASSERT_EQ(group.Volumes[i], SignedVolume(mesh.GetFixedPositions(), cell)) << NameOf(set);
        }
      });
    EXPECT_EQ(measured, cells.size());
  }
}
