// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MembraneScene.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
TraceRay MembraneCase::BendMembrane(const TraceRay& trace) const
{
  if (!this->Mesh)
  {
    return trace;
  }
  return [surface = this->Surface, trace](const reference::Ray& ray)
  { return Compose(Refract(surface, ray, 0.0, false), trace); };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeHeightField(const std::function<double(double, double)>& height,
  const reference::RefractingSurface& surface, double half, int cells)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> triangles;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    const double x = half * (2.0 * i / cells - 1.0);
    const double z = half * (2.0 * j / cells - 1.0);
    const reference::Vector3 place{ x, height(x, z), z };
    points->InsertNextPoint(place.data());
    normals->InsertNextTuple(surface.Normal(place).data());
  }
  for (const auto& [j, i] : Product(Below<vtkIdType>(cells), Below<vtkIdType>(cells)))
  {
    const vtkIdType a = j * (cells + 1) + i;
    const vtkIdType b = a + cells + 1;
    triangles->InsertNextCell({ a, b, a + 1 });
    triangles->InsertNextCell({ a + 1, b, b + 1 });
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  mesh->GetPointData()->SetNormals(normals);
  return mesh;
}

namespace
{

MembraneCase MakeCase(reference::RefractingSurface surface,
  const std::function<double(double, double)>& height, double half, int cells)
{
  surface.Has = [half](const reference::Vector3& x)
  { return std::fabs(x[0]) <= half && std::fabs(x[2]) <= half; };
  return { MakeHeightField(height, surface, half, cells), surface };
}

} // anonymous namespace

//------------------------------------------------------------------------------
MembraneCase MakePlaneCase(double level, double half, int cells)
{
  return MakeCase(
    reference::MakePlane({ 0.0, level, 0.0 }, { 0.0, 1.0, 0.0 }),
    [level](double, double) { return level; }, half, cells);
}

//------------------------------------------------------------------------------
MembraneCase MakeDomeCase(double apex, double radius, double half, int cells)
{
  reference::RefractingSurface sphere = reference::MakeSphere({ 0.0, apex - radius, 0.0 }, radius);
  MembraneCase result = MakeCase(
    sphere,
    [=](double x, double z) { return apex - radius + std::sqrt(radius * radius - x * x - z * z); },
    half, cells);
  result.Surface.Has = [=](const reference::Vector3& x)
  { return x[1] > apex - radius && std::fabs(x[0]) <= half && std::fabs(x[2]) <= half; };
  return result;
}

//------------------------------------------------------------------------------
MembraneCase MakeWavesCase(double level, double amplitude, double k, double half, int cells)
{
  return MakeCase(
    reference::MakeWaves(level, amplitude, k),
    [=](double x, double z) { return level + amplitude * std::sin(k * x) * std::sin(k * z); }, half,
    cells);
}

} // namespace meniscus::test
