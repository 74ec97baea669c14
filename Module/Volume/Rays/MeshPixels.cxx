// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/MeshPixels.h"

#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** Place of a point of the frame in the image, in pixels from its centre. */
glm::dvec2 PixelOf(const RayFrame& frame, const glm::dvec3& point)
{
  const double depth = point.z;
  const glm::dmat2 perPixel(frame.Origin.PerColumn + depth * frame.Slope.PerColumn,
    frame.Origin.PerRow + depth * frame.Slope.PerRow);
  return glm::inverse(perPixel) *
    (glm::dvec2(point) - frame.Origin.Base - depth * frame.Slope.Base);
}

}

//------------------------------------------------------------------------------
ProjectedFaces::PixelBox FindMeshPixels(
  const RayFrame& frame, int width, int height, const TetrahedralMesh& mesh)
{
  const ProjectedFaces::PixelBox all{ 0, width, 0, height };
  if (!frame.ShowsWholeDepth())
  {
    return all;
  }
  const glm::dmat3 toFrame =
    glm::transpose(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth)) / mesh.GetRadius();
  glm::dvec2 lower(0.0);
  glm::dvec2 upper(0.0);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 signs(
      (corner & 1) * 2.0 - 1.0, (corner >> 1 & 1) * 2.0 - 1.0, (corner >> 2) * 2.0 - 1.0);
    const glm::dvec2 pixel = PixelOf(frame, toFrame * (signs * mesh.GetHalfSize()));
    if (!std::isfinite(pixel.x + pixel.y))
    {
      return all;
    }
    lower = corner == 0 ? pixel : glm::min(lower, pixel);
    upper = corner == 0 ? pixel : glm::max(upper, pixel);
  }
  // One pixel for the places of several rays in a pixel and the rounding of rays, which is less.
  const auto clamped = [](double place, int size)
  { return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(size))); };
  const glm::dvec2 center(0.5 * width, 0.5 * height);
  lower = glm::floor(lower + center) - 1.0;
  upper = glm::ceil(upper + center) + 1.0;
  return { clamped(lower.x, width), clamped(upper.x, width), clamped(lower.y, height),
    clamped(upper.y, height) };
}

}
