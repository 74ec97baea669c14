// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus
{

using Triangle = std::array<int, 3>;

/** Triangles over shared points, counterclockwise as seen from outside. */
struct TriangleSurface
{
  std::vector<glm::dvec3> Points;
  std::vector<Triangle> Triangles;
  /** Indices of the points in the data from which the surface was made. */
  std::vector<std::size_t> Sources;
};

/** Reasons why a surface does not bound a solid. */
enum class SurfaceFault
{
  None,
  Empty,       ///< no triangle with three different corners
  NotFinite,   ///< a coordinate of a corner is not finite
  Open,        ///< an edge of one triangle only
  NonManifold, ///< an edge of more than two triangles
  Winding,     ///< an edge that both of its triangles use in the same direction
  InsideOut    ///< a volume that is not positive
};

/**
 * Fault of a surface and the number of edges that have it; of points for NotFinite, of all
 * triangles for InsideOut, 0 for Empty.
 */
struct SurfaceReport
{
  SurfaceFault Fault = SurfaceFault::None;
  std::size_t Count = 0;
};

/**
 * Surface of the used points. Points of equal coordinates become one, in the order of their first
 * use, and triangles that lose a corner by that are left out.
 */
TriangleSurface JoinCoincidentPoints(
  const std::vector<glm::dvec3>& points, const std::vector<Triangle>& triangles);

/** First fault of a surface, in the order of SurfaceFault. Crossing triangles are not looked for.
 */
SurfaceReport FindSurfaceFault(const TriangleSurface& surface);

/** Volume inside of a closed surface; negative if the triangles are wound the other way round. */
double ComputeEnclosedVolume(const TriangleSurface& surface);

/**
 * Number of times that a closed surface winds around a point that is not on it: 1 inside, 0
 * outside, for a surface whose normals point outwards.
 */
int ComputeWindingNumber(const TriangleSurface& surface, const glm::dvec3& point);

} // namespace meniscus
