// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which part of the geometry a camera may see through the membrane. A cell is in view if the ray
 * tube of a facet in view may hold a point of its bounding cube, or if it may be in front of the
 * membrane. What a cell in view needs is solved in whole chunks of points, with all of the
 * membrane: the result is the same as without a view.
 */
#ifndef meniscus_Filters_Object_ViewSelection_h
#define meniscus_Filters_Object_ViewSelection_h

#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Object/ObjectTopology.h"

#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkCamera;

namespace meniscus
{

/**
 * Planes that bound the view from the sides, and one through the eye across it; what is in view is
 * on their positive side. `aspect` is width over height; 0: not known, so only the sides that do
 * not depend on it are there.
 */
std::vector<ViewPlane> FindViewPlanes(vtkCamera* camera, double aspect);

struct ViewSelection
{
  bool IsActive = false;    ///< otherwise all is selected
  std::vector<bool> Cells;  ///< by the id of the input
  std::vector<bool> Chunks; ///< of points, ObjectImages::Chunk each
  vtkIdType CulledCells = 0;
  vtkIdType CulledPoints = 0;

  bool HasCell(vtkIdType cell) const
  {
    return !this->IsActive || this->Cells[static_cast<std::size_t>(cell)];
  }
  bool HasPoint(std::size_t point) const
  {
    return !this->IsActive || this->Chunks[point / ObjectImages::Chunk];
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

#endif
