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

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace meniscus
{

namespace
{

/** Value of an added point on the surface: weighted values of three points of the input. */
struct SurfacePlace
{
  std::array<vtkIdType, 3> Points = { 0, 0, 0 };
  std::array<double, 3> Weights = { 1.0, 0.0, 0.0 };
};

//------------------------------------------------------------------------------
// The joined surface as data whose point i is that of the kernel.
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
// Places of the points on the boundary, in the triangle that is nearest.
std::vector<SurfacePlace> FindPlaces(
  const TriangleSurface& surface, const TetrahedronCells& cells, const std::vector<bool>& boundary)
{
  const auto data = ToPolyData(surface);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  std::vector<SurfacePlace> places(cells.Points.size());
  for (std::size_t p = 0; p < cells.Points.size(); ++p)
  {
    SurfacePlace& place = places[p];
    if (p < surface.Points.size())
    {
      place.Points.fill(static_cast<vtkIdType>(surface.Sources[p]));
      continue;
    }
    if (!boundary[p])
    {
      continue;
    }
    double closest[3];
    double distance = 0.0;
    vtkIdType id = -1;
    int part = 0;
    locator->FindClosestPoint(&cells.Points[p].x, closest, cell, id, part, distance);
    double local[3];
    data->GetCell(id, cell);
    cell->EvaluatePosition(closest, nullptr, part, local, distance, place.Weights.data());
    for (std::size_t i = 0; i < 3; ++i)
    {
      const int corner = surface.Triangles[static_cast<std::size_t>(id)][i];
      place.Points[i] = static_cast<vtkIdType>(surface.Sources[static_cast<std::size_t>(corner)]);
    }
  }
  return places;
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
  vtkPointData* arrays = data->GetPointData();
  if (arrays->GetNumberOfArrays() == 0)
  {
    return 0;
  }
  std::vector<bool> given = FindBoundaryPoints(cells);
  const std::vector<SurfacePlace> places = FindPlaces(surface, cells, given);
  const HarmonicField field(cells, given);
  const auto count = static_cast<vtkIdType>(cells.Points.size());
  int failures = 0;
  grid->GetPointData()->CopyGlobalIdsOff();
  for (int a = 0; a < arrays->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* source = arrays->GetArray(a); // null for strings
    if (!source || source == arrays->GetGlobalIds() || source == arrays->GetPedigreeIds())
    {
      continue;
    }
    auto target = vtk::TakeSmartPointer(source->NewInstance());
    target->SetName(source->GetName());
    target->SetNumberOfComponents(source->GetNumberOfComponents());
    target->SetNumberOfTuples(count);
    const bool isReal = source->GetDataType() == VTK_FLOAT || source->GetDataType() == VTK_DOUBLE;
    bool failed = false;
    for (int component = 0; component < source->GetNumberOfComponents(); ++component)
    {
      std::vector<double> values(cells.Points.size(), 0.0);
      for (std::size_t p = 0; p < values.size(); ++p)
      {
        for (std::size_t i = 0; given[p] && i < 3; ++i)
        {
          values[p] += places[p].Weights[i] == 0.0
            ? 0.0
            : places[p].Weights[i] * source->GetComponent(places[p].Points[i], component);
        }
      }
      const bool continued = field.Continue(values);
      failed = failed || !continued;
      for (vtkIdType p = 0; p < count; ++p)
      {
        const auto i = static_cast<std::size_t>(p);
        const double value = given[i] || continued
          ? values[i]
          : (isReal ? std::numeric_limits<double>::quiet_NaN() : 0.0);
        target->SetComponent(p, component, isReal ? value : std::round(value));
      }
    }
    failures += failed ? 1 : 0;
    const int index = grid->GetPointData()->AddArray(target);
    const int role = arrays->IsArrayAnAttribute(a);
    if (role >= 0)
    {
      grid->GetPointData()->SetActiveAttribute(index, role);
    }
  }
  return failures;
}

} // namespace meniscus
