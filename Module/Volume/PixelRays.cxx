// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/PixelRays.h"

#include "Volume/TetrahedralMesh.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

constexpr double GridRadius = 536870912.0; // 2^29

/** Row of u (axis 0) or v (axis 1), in units of the radius: (x - Slope d, -Origin). */
PixelRays::AffineRow RowOfAxis(const RayFrame& frame, int axis)
{
  const glm::dvec3& position = axis == 0 ? frame.RowX : frame.RowY;
  const auto row = [&](const glm::dvec3& start, const glm::dvec2& slope, const glm::dvec2& origin)
  { return glm::dvec4(start - slope[axis] * frame.RowDepth, -origin[axis]); };
  return { row(position, frame.Slope.Base, frame.Origin.Base),
    row(glm::dvec3(0.0), frame.Slope.PerColumn, frame.Origin.PerColumn),
    row(glm::dvec3(0.0), frame.Slope.PerRow, frame.Origin.PerRow) };
}

/** Applies units: of the grid, and fixed point for what multiplies positions. */
void Scale(PixelRays::AffineRow& row, double toGrid)
{
  const glm::dvec4 unit(glm::dvec3(toGrid * TetrahedralMesh::PositionUnit), toGrid);
  row.Base *= unit;
  row.PerColumn *= unit;
  row.PerRow *= unit;
}

}

//------------------------------------------------------------------------------
PixelRays::PixelRays(const RayFrame& frame, int width, int height)
  : Frame(frame)
  , Width(width)
  , Height(height)
  , U(RowOfAxis(frame, 0))
  , V(RowOfAxis(frame, 1))
  , Depth(TetrahedralMesh::PositionUnit * frame.RowDepth, 0.0)
{
  // The length of an affine function is largest at a corner.
  double longest = 0.0;
  for (const int column : { 0, width - 1 })
  {
    for (const int row : { 0, height - 1 })
    {
      const glm::dvec2 pixel = this->FromCenter(column, row);
      longest = std::max({ longest, glm::length(glm::dvec3(this->U.At(pixel.x, pixel.y))),
        glm::length(glm::dvec3(this->V.At(pixel.x, pixel.y))) });
    }
  }
  const double toGrid = longest > 0.0 ? GridRadius / longest : 0.0;
  Scale(this->U, toGrid);
  Scale(this->V, toGrid);
}

//------------------------------------------------------------------------------
PacketRay PixelRays::RayOf(int column, int row) const
{
  const glm::dvec2 pixel = this->FromCenter(column, row);
  const glm::dvec4 u = this->U.At(pixel.x, pixel.y);
  const glm::dvec4 v = this->V.At(pixel.x, pixel.y);
  const glm::dvec2 slope = this->Frame.Slope.At(pixel.x, pixel.y);
  PacketRay ray;
  for (int k = 0; k < 4; ++k)
  {
    ray.U[k] = u[k];
    ray.V[k] = v[k];
    ray.Depth[k] = this->Depth[k];
  }
  ray.LengthPerDepth =
    static_cast<float>(glm::length(this->Frame.ViewToWorld * glm::dvec3(slope.x, slope.y, 1.0)));
  ray.StartDepth = static_cast<float>(this->Frame.NearDepth);
  ray.EndDepth = 1.0e+30f;
  ray.FirstEntry = 0;
  ray.EndEntry = 0;
  return ray;
}

}
