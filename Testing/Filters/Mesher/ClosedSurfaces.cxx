// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/ClosedSurfaces.h"

#include "vtkAppendPolyData.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkReverseSense.h"

using namespace meniscus::test;

namespace meniscus::test
{

namespace
{

Surface MakeSurface(vtkPoints* points, vtkCellArray* triangles)
{
  auto surface = Surface::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

void AddQuad(vtkCellArray* triangles, vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d)
{
  triangles->InsertNextCell({ a, b, c });
  triangles->InsertNextCell({ a, c, d });
}

Surface CopyOf(vtkPolyData* surface)
{
  auto copy = Surface::New();
  copy->DeepCopy(surface);
  return copy;
}

// A new list of triangles, with one of them changed.
template <class Change>
void Rebuild(vtkPolyData* surface, vtkIdType triangle, const Change& change)
{
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < surface->GetNumberOfCells(); ++c)
  {
    surface->GetPolys()->GetCellAtId(c, ids);
    if (c != triangle)
    {
      triangles->InsertNextCell(ids);
    }
    else
    {
      change(triangles.Get(), ids.Get());
    }
  }
  surface->SetPolys(triangles);
  surface->DeleteCells();
}

// Winds all triangles of a surface around the origin counterclockwise as seen from outside.
void TurnOutwards(vtkPolyData* surface)
{
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetPolys()->GetCellAtId(t, ids);
    double x[3][3];
    for (int i = 0; i < 3; ++i)
    {
      surface->GetPoint(ids->GetId(i), x[i]);
    }
    const bool outwards = vtkMath::Determinant3x3(x[0], x[1], x[2]) > 0.0;
    triangles->InsertNextCell(
      { ids->GetId(0), ids->GetId(outwards ? 1 : 2), ids->GetId(outwards ? 2 : 1) });
  }
  surface->SetPolys(triangles);
}

// Each triangle as four, over the middles of its edges.
Surface Divided(vtkPolyData* surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(surface->GetPoints());
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> middles;
  const auto middle = [&](vtkIdType a, vtkIdType b)
  {
    const auto known = middles.emplace(std::minmax(a, b), points->GetNumberOfPoints());
    if (known.second)
    {
      const glm::dvec3 x = PointOf(points, a);
      const glm::dvec3 y = PointOf(points, b);
      points->InsertNextPoint(0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1]), 0.5 * (x[2] + y[2]));
    }
    return known.first->second;
  };
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetPolys()->GetCellAtId(t, ids);
    const vtkIdType a = ids->GetId(0);
    const vtkIdType b = ids->GetId(1);
    const vtkIdType c = ids->GetId(2);
    const vtkIdType ab = middle(a, b);
    const vtkIdType bc = middle(b, c);
    const vtkIdType ca = middle(c, a);
    triangles->InsertNextCell({ a, ab, ca });
    triangles->InsertNextCell({ ab, b, bc });
    triangles->InsertNextCell({ ca, bc, c });
    triangles->InsertNextCell({ ab, bc, ca });
  }
  return MakeSurface(points, triangles);
}

} // anonymous namespace

//------------------------------------------------------------------------------
Surface MakeBox(double x, double y, double z)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 8; ++i)
  {
    points->InsertNextPoint((i & 1) != 0 ? x : 0.0, (i & 2) != 0 ? y : 0.0, (i & 4) != 0 ? z : 0.0);
  }
  vtkNew<vtkCellArray> triangles;
  AddQuad(triangles, 0, 2, 3, 1);
  AddQuad(triangles, 4, 5, 7, 6);
  AddQuad(triangles, 0, 1, 5, 4);
  AddQuad(triangles, 2, 6, 7, 3);
  AddQuad(triangles, 0, 4, 6, 2);
  AddQuad(triangles, 1, 3, 7, 5);
  return MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
Surface MakeSphere(double radius, int theta, int phi)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(0.0, 0.0, radius);
  points->InsertNextPoint(0.0, 0.0, -radius);
  const auto at = [&](int i, int j) { return 2 + (j - 1) * theta + i % theta; };
  for (const auto& [j, i] : Product(Numbers(1, phi), theta))
  {
    const double u = 2.0 * vtkMath::Pi() * i / theta;
    const double v = vtkMath::Pi() * j / phi;
    points->InsertNextPoint(
      radius * std::sin(v) * std::cos(u), radius * std::sin(v) * std::sin(u), radius * std::cos(v));
  }
  vtkNew<vtkCellArray> triangles;
  for (int i = 0; i < theta; ++i)
  {
    triangles->InsertNextCell({ 0, at(i, 1), at(i + 1, 1) });
    for (int j = 1; j + 1 < phi; ++j)
    {
      AddQuad(triangles, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
    triangles->InsertNextCell({ 1, at(i + 1, phi - 1), at(i, phi - 1) });
  }
  return MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
// Frusta over regular polygons, which have a common apex.
double SphereVolume(double radius, int theta, int phi)
{
  const double polygon = 0.5 * theta * std::sin(2.0 * vtkMath::Pi() / theta);
  double volume = 0.0;
  for (int j = 0; j < phi; ++j)
  {
    const double above = vtkMath::Pi() * j / phi;
    const double below = vtkMath::Pi() * (j + 1) / phi;
    const double r = radius * std::sin(above);
    const double s = radius * std::sin(below);
    volume +=
      radius * (std::cos(above) - std::cos(below)) / 3.0 * polygon * (r * r + s * s + r * s);
  }
  return volume;
}

//------------------------------------------------------------------------------
Surface MakeGeodesicSphere(double radius, int levels)
{
  vtkNew<vtkPlatonicSolidSource> icosahedron;
  icosahedron->SetSolidTypeToIcosahedron();
  icosahedron->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  icosahedron->Update();
  Surface surface = Surface::New();
  surface->SetPoints(icosahedron->GetOutput()->GetPoints());
  surface->SetPolys(icosahedron->GetOutput()->GetPolys());
  TurnOutwards(surface); // VTK winds this one the other way round
  for (int level = 0; level <= levels; ++level)
  {
    if (level > 0)
    {
      surface = Divided(surface);
    }
    MapPoints(surface, [radius](const glm::dvec3& x) { return radius * glm::normalize(x); });
  }
  return surface;
}

//------------------------------------------------------------------------------
// Pyramids from the centre, whose heights and areas come from the lengths of edges.
double GeodesicSphereVolume(double radius, int levels)
{
  const Surface surface = MakeGeodesicSphere(radius, levels);
  double volume = 0.0;
  for (vtkIdType c = 0; c < surface->GetNumberOfCells(); ++c)
  {
    vtkIdList* ids = surface->GetCell(c)->GetPointIds();
    double corner[3][3];
    for (int i = 0; i < 3; ++i)
    {
      surface->GetPoint(ids->GetId(i), corner[i]);
    }
    const double a = std::sqrt(vtkMath::Distance2BetweenPoints(corner[0], corner[1]));
    const double b = std::sqrt(vtkMath::Distance2BetweenPoints(corner[1], corner[2]));
    const double d = std::sqrt(vtkMath::Distance2BetweenPoints(corner[2], corner[0]));
    const double s = 0.5 * (a + b + d);
    const double area = std::sqrt(s * (s - a) * (s - b) * (s - d));
    const double circumradius = 0.25 * a * b * d / area;
    volume += area * std::sqrt(radius * radius - circumradius * circumradius) / 3.0;
  }
  return volume;
}

//------------------------------------------------------------------------------
Surface MakeTorus(double radius, double tube, int around, int across)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (const auto& [i, j] : Product(around, across))
  {
    const double u = 2.0 * vtkMath::Pi() * i / around;
    const double v = 2.0 * vtkMath::Pi() * j / across;
    const double r = radius + tube * std::cos(v);
    points->InsertNextPoint(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
    AddQuad(triangles, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
// A point at the distance r from the axis sweeps chords: dV = around sin(2 pi / around) r dA.
double TorusVolume(double radius, double tube, int around, int across)
{
  const double polygon = 0.5 * across * tube * tube * std::sin(2.0 * vtkMath::Pi() / across);
  return around * std::sin(2.0 * vtkMath::Pi() / around) * radius * polygon;
}

//------------------------------------------------------------------------------
Surface Reversed(vtkPolyData* surface)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(surface);
  reverse->ReverseCellsOn();
  reverse->Update();
  return CopyOf(reverse->GetOutput());
}

//------------------------------------------------------------------------------
Surface Moved(vtkPolyData* surface, const std::array<double, 3>& by)
{
  Surface copy = CopyOf(surface);
  MapPoints(copy, [&by](const glm::dvec3& x) { return x + glm::dvec3(by[0], by[1], by[2]); });
  return copy;
}

//------------------------------------------------------------------------------
// All points in a plane, no two of them in one place.
Surface Flattened(vtkPolyData* surface)
{
  Surface copy = CopyOf(surface);
  MapPoints(
    copy, [](const glm::dvec3& x) { return glm::dvec3(x.x + 2.0 * x.z, x.y + 2.0 * x.z, 0.0); });
  return copy;
}

//------------------------------------------------------------------------------
Surface Joined(const std::vector<Surface>& surfaces)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const Surface& surface : surfaces)
  {
    append->AddInputData(surface);
  }
  append->Update();
  return CopyOf(append->GetOutput());
}

//------------------------------------------------------------------------------
void RemoveTriangle(vtkPolyData* surface, vtkIdType triangle)
{
  Rebuild(surface, triangle, [](vtkCellArray*, vtkIdList*) {});
}

//------------------------------------------------------------------------------
void TurnTriangle(vtkPolyData* surface, vtkIdType triangle)
{
  Rebuild(surface, triangle,
    [](vtkCellArray* triangles, vtkIdList* ids) {
      triangles->InsertNextCell({ ids->GetId(0), ids->GetId(2), ids->GetId(1) });
    });
}

}
