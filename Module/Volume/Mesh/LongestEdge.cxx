// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/LongestEdge.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace meniscus
{

//------------------------------------------------------------------------------
double ComputeLongestEdge(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  const auto& cells = mesh.GetCells();
  std::vector<double> longest(NumberOfBlocks(cells.size()), 0.0);
  ForEachBlock(cells.size(), loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      double square = 0.0;
      for (std::size_t c = first; c < last; ++c)
      {
        glm::dvec3 p[4];
        for (int i = 0; i < 4; ++i)
        {
          p[i] = mesh.GetPosition(cells[c].Vertices[i]);
        }
        for (int i = 0; i < 4; ++i)
        {
          for (int j = i + 1; j < 4; ++j)
          {
            square = std::max(square, glm::dot(p[j] - p[i], p[j] - p[i]));
          }
        }
      }
      longest[block] = std::sqrt(square);
    });
  return longest.empty() ? 0.0 : *std::max_element(longest.begin(), longest.end());
}

}
