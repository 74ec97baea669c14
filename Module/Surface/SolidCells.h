// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surface/ClosedSurface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus
{

using Tetrahedron = std::array<int, 4>;

/** Tetrahedra; their first points are the points of a surface. */
struct TetrahedronCells
{
  std::vector<glm::dvec3> Points;
  std::vector<Tetrahedron> Cells;
  /** Parts of space that the surface separates, one number per cell. */
  std::vector<int> Regions;
};

/** Reasons why tetrahedra do not fill the inside of a surface. */
enum class SolidFault
{
  None,
  LostFacets,  ///< triangles of the surface that are no faces of cells
  Nesting,     ///< a region that the surface encloses more than once, or inside out
  FlatCells,   ///< cells without volume
  WrongVolume, ///< cells whose volume is not the volume of the surface
};

/**
 * Numbers the regions that the triangles of the surface separate, as faces of the cells. Returns
 * the number of triangles that are no faces of cells; the regions mean nothing unless it is 0.
 */
std::size_t NumberRegions(const TriangleSurface& surface, TetrahedronCells& cells);

/**
 * Keeps the cells in the regions around which the surface winds once, in VTK's order of corners,
 * with the surface's points and those that the cells use.
 * @param relativeTolerance distance from a plane, relative to the diagonal of the surface's bounds,
 *   at which the mesher may place points on a triangle.
 */
SolidFault KeepSolid(
  const TriangleSurface& surface, double relativeTolerance, TetrahedronCells& cells);

/**
 * Keeps the cells in the regions around which the surface does not wind: the rest of the convex
 * hull, cavities included. Order of corners, points and tolerance as for KeepSolid.
 */
SolidFault KeepOutside(
  const TriangleSurface& surface, double relativeTolerance, TetrahedronCells& cells);

/**
 * Boundary of the cells: faces of one cell only, counterclockwise as seen from outside. Points of
 * equal coordinates count as one, and cells that lose a corner by that are left out. The order of
 * the cells' corners does not matter.
 */
TriangleSurface FindBoundary(
  const std::vector<glm::dvec3>& points, const std::vector<Tetrahedron>& cells);

/** Whether each point is on the boundary of the cells, i.e. on a face of one cell only. */
std::vector<bool> FindBoundaryPoints(const TetrahedronCells& cells);

/** Largest ratio of circumscribed radius to shortest edge, and the cells above a bound. */
struct CellQuality
{
  double LargestRadiusEdgeRatio = 0.0;
  std::size_t CellsAboveBound = 0;
};

CellQuality MeasureQuality(const TetrahedronCells& cells, double bound);

} // namespace meniscus
