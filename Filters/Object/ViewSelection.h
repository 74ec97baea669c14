// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Selection of the part of the geometry that a camera may see through the membrane. A cell is in
 * view if the ray tube of a facet in view may hold a point of its bounding cube, or if the cell may
 * be in front of the membrane. The points needed for the cells in view are solved in whole chunks,
 * with the entire membrane, so that the result is the same as without a selection.
 */
#pragma once

#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Object/ObjectTopology.h"

#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkBoundingBox;
class vtkCamera;

namespace meniscus
{

/**
 * Planes that bound the view on its sides, and one through the eye perpendicular to the view
 * direction; the visible part is on their positive sides. `aspect` is width over height; if it is 0
 * (unknown), only the planes that do not depend on it are returned.
 */
std::vector<ViewPlane> FindViewPlanes(vtkCamera* camera, double aspect);

/** Eye of a camera. */
struct CameraEye
{
  glm::dvec3 Position{ 0.0 }; ///< world coordinates
  /**
   * Angle, as seen from the eye, that is the same part of the picture's height as one degree is of
   * a picture with a view angle of 30 degrees; radians. In perspective, one degree.
   */
  double Degree = 0.0;
};

/**
 * Eye of a camera. A camera in parallel projection has its eye at infinity: the result is a point
 * against its direction, 1e5 sizes of the surfaces away, from where rays are parallel up to the
 * inverse of that. It depends on direction and surfaces only, so that a camera that is moved along
 * with its focal point keeps its eye.
 * @param bounds bounds of the surfaces; invalid ones are not used
 */
CameraEye FindEye(vtkCamera* camera, const vtkBoundingBox& bounds);

struct ViewSelection
{
  bool IsActive = false;    ///< false: everything is selected
  std::vector<bool> Cells;  ///< by id of the input cell
  std::vector<bool> Chunks; ///< of points, CellImages::Chunk points each
  vtkIdType CulledCells = 0;
  vtkIdType CulledPoints = 0;

  bool HasCell(vtkIdType cell) const
  {
    return !this->IsActive || this->Cells[static_cast<std::size_t>(cell)];
  }
  bool HasPoint(std::size_t point) const
  {
    return !this->IsActive || this->Chunks[point / CellImages::Chunk];
  }
  bool operator==(const ViewSelection& o) const
  {
    return this->IsActive == o.IsActive && this->Cells == o.Cells && this->Chunks == o.Chunks;
  }
};

/** Selects cells and points (x, y, z each) for the view of `scene`. */
ViewSelection SelectInView(const RefractionScene& scene, const ObjectTopology& topology,
  vtkIdType numberOfCells, const std::vector<double>& points);

/** The cells of `topology` that are selected. */
ObjectTopology SelectCells(const ObjectTopology& topology, const ViewSelection& selection);

}
