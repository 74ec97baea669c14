// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/PlacedVertices.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Rays/FixedPointRays.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void PlaceVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars,
  const FixedPointRays& rays, const RangeLoop& loop, std::vector<PacketVertex>& vertices)
{
  vertices.resize(mesh.GetFixedPositions().size());
  ForEachInBlocks(vertices.size(), loop,
    [&](std::size_t v)
    {
      const glm::ivec3 place = rays.Place(mesh.GetFixedPositions()[v]);
      vertices[v] = { { place.x, place.y, place.z }, scalars.empty() ? 0.0f : scalars[v] };
    });
}

}
