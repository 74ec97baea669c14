// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/SourceCells.h"

#include "Common/BlockLoop.h"
#include "Common/GroupedItems.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

namespace meniscus
{
namespace
{

using Quad = std::array<std::int32_t, 4>;

/** Cells of a mesh by their lowest vertex. */
GroupedItems ListCells(const TetrahedralMesh& mesh)
{
  GroupedItems byVertex;
  byVertex.Set(static_cast<std::size_t>(mesh.GetNumberOfVertices()),
    [&cells = mesh.GetCells()](const auto& visit)
    {
      for (std::size_t c = 0; c < cells.size(); ++c)
      {
        visit(static_cast<std::size_t>(cells[c].Vertices[0]), static_cast<std::int32_t>(c));
      }
    });
  return byVertex;
}

/** Vertices of an input cell in ascending order; the first is negative if one is missing. */
Quad VerticesOf(
  const TetrahedraView& input, const std::vector<std::int32_t>& vertexOfPoint, std::size_t cell)
{
  Quad vertices;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::int64_t point =
      input.ShortCells ? std::int64_t{ input.ShortCells[4 * cell + i] } : input.Cells[4 * cell + i];
    const bool inRange = point >= 0 && point < input.NumberOfPoints;
    vertices[i] = inRange ? vertexOfPoint[static_cast<std::size_t>(point)] : -1;
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}

//------------------------------------------------------------------------------
std::vector<std::int32_t> FindSourceCells(
  const TetrahedralMesh& mesh, const TetrahedraView& input, const RangeLoop& loop)
{
  std::vector<std::int32_t> vertexOfPoint(static_cast<std::size_t>(input.NumberOfPoints), -1);
  const std::vector<std::int32_t>& points = mesh.GetSourcePoints();
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    vertexOfPoint[static_cast<std::size_t>(points[v])] = static_cast<std::int32_t>(v);
  }
  const GroupedItems byVertex = ListCells(mesh);
  constexpr std::int32_t none = -1;
  const auto size = static_cast<std::size_t>(mesh.GetNumberOfCells());
  const std::unique_ptr<std::atomic<std::int32_t>[]> found(new std::atomic<std::int32_t>[size]);
  for (std::size_t c = 0; c < size; ++c)
  {
    found[c].store(none, std::memory_order_relaxed);
  }
  ForEachBlock(static_cast<std::size_t>(input.NumberOfCells), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        const bool isLeftOut = input.CellFlags && (input.CellFlags[c] & input.LeftOutBits) != 0;
        const Quad vertices = VerticesOf(input, vertexOfPoint, c);
        if (isLeftOut || vertices[0] < 0)
        {
          continue;
        }
        for (const std::int32_t i : byVertex[static_cast<std::size_t>(vertices[0])])
        {
          const auto cell = static_cast<std::size_t>(i);
          if (mesh.GetCells()[cell].Vertices != vertices)
          {
            continue;
          }
          // The mesh keeps the first one of equal cells of the input.
          const auto number = static_cast<std::int32_t>(c);
          std::int32_t before = found[cell].load(std::memory_order_relaxed);
          while ((before == none || number < before) &&
            !found[cell].compare_exchange_weak(before, number, std::memory_order_relaxed))
          {
          }
        }
      }
    });
  std::vector<std::int32_t> sources(size);
  for (std::size_t c = 0; c < size; ++c)
  {
    const std::int32_t number = found[c].load(std::memory_order_relaxed);
    sources[c] = number != none && input.SourceCells ? input.SourceCells[number] : number;
  }
  return sources;
}

}
