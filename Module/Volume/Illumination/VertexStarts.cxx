// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/VertexStarts.h"

#include "Common/BlockLoop.h"
#include "Volume/Refracted/RayBundleEntries.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
void VertexStarts::Build(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  this->Inside = !HasInvertedCells(mesh, loop);
  const auto cells = static_cast<std::size_t>(mesh.GetNumberOfCells());
  std::vector<float> volumes(cells, -1.0f);
  ForEachBlock(cells, loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        if (mesh.IsActiveCell(static_cast<std::int64_t>(c)))
        {
          const auto& ids = mesh.GetCells()[c].Vertices;
          const glm::dvec3 corner = mesh.GetPosition(ids[0]);
          const glm::dvec3 edges[3] = { mesh.GetPosition(ids[1]) - corner,
            mesh.GetPosition(ids[2]) - corner, mesh.GetPosition(ids[3]) - corner };
          volumes[c] =
            static_cast<float>(std::abs(glm::dot(edges[0], glm::cross(edges[1], edges[2]))));
        }
      }
    });
  const auto vertices = static_cast<std::size_t>(mesh.GetNumberOfVertices());
  this->Cells.assign(vertices, -1);
  for (std::size_t c = 0; c < cells; ++c)
  {
    for (const std::int32_t vertex : mesh.GetCells()[c].Vertices)
    {
      std::int32_t& best = this->Cells[static_cast<std::size_t>(vertex)];
      if (volumes[c] >= 0.0f && (best < 0 || volumes[c] > volumes[static_cast<std::size_t>(best)]))
      {
        best = static_cast<std::int32_t>(c);
      }
    }
  }
  this->Vertices.clear();
  for (std::size_t v = 0; v < vertices; ++v)
  {
    if (this->Cells[v] >= 0)
    {
      this->Vertices.push_back(static_cast<std::int32_t>(v));
    }
  }
  this->FindPlaces(mesh, loop);
}

//------------------------------------------------------------------------------
void VertexStarts::FindPlaces(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  this->Places.resize(this->Cells.size());
  ForEachBlock(this->Vertices.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const std::int32_t vertex = this->Vertices[i];
        const glm::dvec3 place = mesh.GetPosition(vertex);
        glm::dvec3 center(0.0);
        for (const std::int32_t corner :
          mesh.GetCells()[static_cast<std::size_t>(this->GetCell(vertex))].Vertices)
        {
          center += 0.25 * mesh.GetPosition(corner);
        }
        this->Places[static_cast<std::size_t>(vertex)] = place + Share * (center - place);
      }
    });
}

}
