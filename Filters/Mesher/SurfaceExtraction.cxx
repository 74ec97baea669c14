// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesher/SurfaceExtraction.h"

#include "Surface/HarmonicField.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStaticCellLocator.h"
#include "vtkTriangleFilter.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace meniscus
{

namespace
{

//------------------------------------------------------------------------------
// The joined surface as data with the points of the kernel, in their order.
vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleSurface& surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const glm::dvec3& point : surface.Points)
  {
    points->InsertNextPoint(&point.x);
  }
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& triangle : surface.Triangles)
  {
    triangles->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

//------------------------------------------------------------------------------
// Sets the arrays at points that were added on the surface, by interpolation in the triangle that
// is nearest.
void InterpolateOnSurface(vtkPointData* arrays, const TriangleSurface& surface,
  const TetrahedronCells& cells, const std::vector<std::size_t>& added, vtkPointData* target)
{
  const auto data = ToPolyData(surface);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  vtkNew<vtkIdList> corners;
  for (const std::size_t p : added)
  {
    double closest[3];
    double distance = 0.0;
    vtkIdType id = -1;
    int part = 0;
    locator->FindClosestPoint(&cells.Points[p].x, closest, cell, id, part, distance);
    double local[3];
    double weights[3];
    data->GetCell(id, cell);
    cell->EvaluatePosition(closest, nullptr, part, local, distance, weights);
    // A value that is not finite does not count where its weight is zero.
    double used[3];
    corners->Reset();
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (weights[i] != 0.0)
      {
        const int corner = surface.Triangles[static_cast<std::size_t>(id)][i];
        used[corners->GetNumberOfIds()] = weights[i];
        corners->InsertNextId(
          static_cast<vtkIdType>(surface.Sources[static_cast<std::size_t>(corner)]));
      }
    }
    target->InterpolatePoint(arrays, static_cast<vtkIdType>(p), corners, used);
  }
}

//------------------------------------------------------------------------------
// Continues the components of an array to the points without `given`. Those that have no
// continuation are NaN there, or 0 for integers. Returns false if there is one.
bool ContinueInside(const HarmonicField& field, const std::vector<bool>& given, vtkDataArray* array)
{
  const bool isReal = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  const double none = isReal ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  bool all = true;
  std::vector<double> values(given.size());
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    for (std::size_t p = 0; p < values.size(); ++p)
    {
      values[p] = given[p] ? array->GetComponent(static_cast<vtkIdType>(p), component) : 0.0;
    }
    const bool continued = field.Continue(values);
    all = all && continued;
    for (std::size_t p = 0; p < values.size(); ++p)
    {
      if (!given[p])
      {
        const double value = continued ? values[p] : none;
        array->SetComponent(
          static_cast<vtkIdType>(p), component, isReal ? value : std::round(value));
      }
    }
  }
  return all;
}

} // anonymous namespace

//------------------------------------------------------------------------------
TriangleSurface ExtractSurface(vtkPolyData* data)
{
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(data);
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->SetInputData(copy);
  triangulate->PassVertsOff();
  triangulate->PassLinesOff();
  triangulate->Update();
  vtkPolyData* triangles = triangulate->GetOutput();
  std::vector<glm::dvec3> points(static_cast<std::size_t>(triangles->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    triangles->GetPoint(static_cast<vtkIdType>(i), &points[i].x);
  }
  std::vector<Triangle> corners;
  vtkCellArray* cells = triangles->GetPolys();
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c)
  {
    cells->GetCellAtId(c, ids);
    corners.push_back({ static_cast<int>(ids->GetId(0)), static_cast<int>(ids->GetId(1)),
      static_cast<int>(ids->GetId(2)) });
  }
  return JoinCoincidentPoints(points, corners);
}

//------------------------------------------------------------------------------
void CopyCells(const TetrahedronCells& cells, vtkUnstructuredGrid* grid)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(cells.Points.size()));
  for (std::size_t p = 0; p < cells.Points.size(); ++p)
  {
    points->SetPoint(static_cast<vtkIdType>(p), &cells.Points[p].x);
  }
  vtkNew<vtkCellArray> tetrahedra;
  tetrahedra->AllocateExact(
    static_cast<vtkIdType>(cells.Cells.size()), 4 * static_cast<vtkIdType>(cells.Cells.size()));
  for (const Tetrahedron& cell : cells.Cells)
  {
    tetrahedra->InsertNextCell({ cell[0], cell[1], cell[2], cell[3] });
  }
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, tetrahedra);
}

//------------------------------------------------------------------------------
int ContinueArrays(vtkPolyData* data, const TriangleSurface& surface, const TetrahedronCells& cells,
  vtkUnstructuredGrid* grid)
{
  vtkNew<vtkPointData> arrays;
  arrays->ShallowCopy(data->GetPointData());
  for (int a = arrays->GetNumberOfArrays(); a-- > 0;)
  {
    if (!arrays->GetArray(a)) // strings, for example
    {
      arrays->RemoveArray(a);
    }
  }
  vtkPointData* target = grid->GetPointData();
  target->CopyGlobalIdsOff();
  target->CopyPedigreeIdsOff();
  const auto count = static_cast<vtkIdType>(cells.Points.size());
  target->CopyAllocate(arrays, count);
  target->SetNumberOfTuples(count);
  const std::size_t own = surface.Points.size();
  for (std::size_t p = 0; p < own; ++p)
  {
    target->CopyData(arrays, static_cast<vtkIdType>(surface.Sources[p]), static_cast<vtkIdType>(p));
  }
  if (cells.Points.size() == own || target->GetNumberOfArrays() == 0)
  {
    return 0;
  }
  std::vector<bool> given = FindBoundaryPoints(cells);
  std::vector<std::size_t> onSurface;
  std::size_t inside = 0;
  for (std::size_t p = own; p < given.size(); ++p)
  {
    if (given[p])
    {
      onSurface.push_back(p);
    }
    else
    {
      ++inside;
    }
  }
  if (!onSurface.empty())
  {
    InterpolateOnSurface(arrays, surface, cells, onSurface, target);
  }
  if (inside == 0)
  {
    return 0;
  }
  std::fill_n(given.begin(), own, true);
  const HarmonicField field(cells, given);
  int failures = 0;
  for (int a = 0; a < target->GetNumberOfArrays(); ++a)
  {
    failures += ContinueInside(field, given, target->GetArray(a)) ? 0 : 1;
  }
  return failures;
}

} // namespace meniscus
