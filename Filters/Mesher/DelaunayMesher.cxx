// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesher/DelaunayMesher.h"

#include "vtkCallbackCommand.h"
#include "vtkDelaunay3D.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <glm/common.hpp>

namespace meniscus
{

namespace
{

/**
 * Size of VTK's bounding points relative to the surface. A triangle of the convex hull is lost if
 * its circumscribed sphere reaches them. Squares of their coordinates are rounded to about 1e-12 of
 * the square of the surface's size.
 */
constexpr double BoundingSize = 100.0;

/** Centre of the bounds of points. */
glm::dvec3 GetCenter(const std::vector<glm::dvec3>& points)
{
  glm::dvec3 lowest = points.front();
  glm::dvec3 highest = points.front();
  for (const glm::dvec3& point : points)
  {
    lowest = glm::min(lowest, point);
    highest = glm::max(highest, point);
  }
  return 0.5 * lowest + 0.5 * highest;
}

} // anonymous namespace

//------------------------------------------------------------------------------
TetrahedronCells MeshByDelaunay(const TriangleSurface& surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  // Relative to the surface's centre: VTK squares the coordinates of circumscribed spheres, which
  // far from the origin would lose the digits of the surface.
  const glm::dvec3 center = GetCenter(surface.Points);
  for (const glm::dvec3& point : surface.Points)
  {
    const glm::dvec3 local = point - center;
    points->InsertNextPoint(&local.x);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkDelaunay3D> delaunay;
  delaunay->SetInputData(cloud);
  delaunay->SetTolerance(0.0);
  delaunay->SetOffset(BoundingSize);
  // Its warnings of degenerate cells go nowhere: the cells are checked.
  vtkNew<vtkCallbackCommand> silence;
  delaunay->AddObserver(vtkCommand::WarningEvent, silence);
  delaunay->AddObserver(vtkCommand::ErrorEvent, silence);
  delaunay->Update();
  vtkUnstructuredGrid* grid = delaunay->GetOutput();
  TetrahedronCells cells;
  cells.Points = surface.Points;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCellType(c) == VTK_TETRA)
    {
      grid->GetCellPoints(c, ids);
      cells.Cells.push_back({ static_cast<int>(ids->GetId(0)), static_cast<int>(ids->GetId(1)),
        static_cast<int>(ids->GetId(2)), static_cast<int>(ids->GetId(3)) });
    }
  }
  return cells;
}

} // namespace meniscus
