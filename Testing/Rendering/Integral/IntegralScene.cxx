// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "IntegralScene.h"

namespace meniscus::test
{
namespace
{

glm::dvec3 ToVector(const double* v)
{
  return { v[0], v[1], v[2] };
}

ConvexSolid MakeBox(double low, double high)
{
  ConvexSolid box;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    box.Planes.push_back({ normal, high });
    box.Planes.push_back({ -normal, -low });
  }
  return box;
}

SolidMesh MakeTetrahedron(const Field& field)
{
  ConvexSolid solid;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 normal(0.0);
    normal[axis] = -1.0;
    solid.Planes.push_back({ normal, 0.0 });
  }
  solid.Planes.push_back({ glm::dvec3(1.0), 1.0 });
  return { "tetrahedron", MakeSingleTetrahedron(field), solid };
}

SolidMesh MakeJitteredBlock(const Field& field)
{
  constexpr int n = 8;
  Grid grid = MakeBlock(n, field);
  std::vector<glm::dvec3> before;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    before.push_back(ToVector(grid->GetPoint(i)));
  }
  Jitter(grid, 0.03, 7);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3& old = before[static_cast<std::size_t>(i)];
    const bool inside = std::max({ std::abs(old.x), std::abs(old.y), std::abs(old.z) }) < 0.99;
    glm::dvec3 now = ToVector(grid->GetPoint(i));
    now = inside ? now : old;
    grid->GetPoints()->SetPoint(i, now.x, now.y, now.z);
    scalars->SetTuple1(i, field(now.x, now.y, now.z));
  }
  return { "block", grid, MakeBox(-1.0, 1.0) };
}

/** Rings of trapezoids, which are plane, and a point in the middle. */
SolidMesh MakeBall(const Field& field)
{
  constexpr int rings = 12;
  constexpr int sectors = 17;
  std::vector<double> points{ 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0 };
  for (const auto& [ring, sector] : Product(Numbers(1, rings), sectors))
  {
    const double theta = vtkMath::Pi() * ring / rings;
    const double phi = 2.0 * vtkMath::Pi() * sector / sectors;
    points.insert(points.end(),
      { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta) });
  }
  std::vector<vtkIdType> cells;
  SolidMesh ball{ "ball", nullptr, ConvexSolid() };
  const auto at = [&points](vtkIdType i)
  { return ToVector(&points[static_cast<std::size_t>(3 * i)]); };
  const auto add = [&](vtkIdType a, vtkIdType b, vtkIdType c)
  {
    cells.insert(cells.end(), { 0, a, b, c });
    glm::dvec3 normal = glm::normalize(glm::cross(at(b) - at(a), at(c) - at(a)));
    normal = glm::dot(normal, at(a)) < 0.0 ? -normal : normal;
    ball.Solid.Planes.push_back({ normal, glm::dot(normal, at(a)) });
  };
  const auto id = [](int ring, int sector)
  { return vtkIdType{ 3 } + (ring - 1) * sectors + sector % sectors; };
  for (int sector = 0; sector < sectors; ++sector)
  {
    add(1, id(1, sector), id(1, sector + 1));
    add(2, id(rings - 1, sector), id(rings - 1, sector + 1));
    for (int ring = 1; ring < rings - 1; ++ring)
    {
      add(id(ring, sector), id(ring, sector + 1), id(ring + 1, sector));
      add(id(ring, sector + 1), id(ring + 1, sector + 1), id(ring + 1, sector));
    }
  }
  ball.Mesh = MakeGrid(points, cells, field);
  return ball;
}

}

//------------------------------------------------------------------------------
Stretch ConvexSolid::Clip(const WorldRay& ray, double from) const
{
  Stretch inside{ from, 1.0e30 };
  for (const Plane& plane : this->Planes)
  {
    const double height = plane.Offset - glm::dot(plane.Normal, ray.Origin);
    const double rate = glm::dot(plane.Normal, ray.Direction);
    if (rate > 0.0)
    {
      inside.End = std::min(inside.End, height / rate);
    }
    else if (rate < 0.0)
    {
      inside.Begin = std::max(inside.Begin, height / rate);
    }
    else if (height < 0.0)
    {
      return { 0.0, -1.0 };
    }
  }
  return inside;
}

//------------------------------------------------------------------------------
std::vector<SolidMesh> MakeSolids(const Field& field)
{
  return { MakeTetrahedron(field), MakeJitteredBlock(field), MakeBall(field) };
}

//------------------------------------------------------------------------------
void Enable(vtkTetrahedraRayIntegral* filter, const std::vector<const char*>& arrays)
{
  for (const char* name : arrays)
  {
    filter->GetArraySelection()->EnableArray(name);
  }
}

//------------------------------------------------------------------------------
Filter MakeFilter(
  vtkDataObject* input, int width, int height, const std::vector<const char*>& arrays)
{
  auto filter = Filter::New();
  filter->SetInputData(input);
  filter->SetImageSize(width, height);
  filter->GetArraySelection()->DisableArray("Integral");
  Enable(filter, arrays);
  return filter;
}

//------------------------------------------------------------------------------
void SetRectangle(vtkTetrahedraRayIntegral* filter, const glm::dvec3& direction, double half)
{
  const glm::dvec3 depth = glm::normalize(direction);
  const glm::dvec3 right = glm::normalize(glm::cross(depth, glm::dvec3(0.1, 1.0, 0.2)));
  const glm::dvec3 up = glm::cross(right, depth);
  const glm::dvec3 origin = -2.0 * half * depth - half * (right + up);
  const glm::dvec3 axis1 = 2.0 * half * right;
  const glm::dvec3 axis2 = 2.0 * half * up;
  filter->SetFrameModeToParallel();
  filter->SetFrameOrigin(origin.x, origin.y, origin.z);
  filter->SetFrameAxis1(axis1.x, axis1.y, axis1.z);
  filter->SetFrameAxis2(axis2.x, axis2.y, axis2.z);
}

//------------------------------------------------------------------------------
WorldRay RayOf(vtkTetrahedraRayIntegral* filter, int column, int row)
{
  const int* size = filter->GetImageSize();
  const double across = (column + 0.5) / size[0];
  const double upward = (row + 0.5) / size[1];
  if (filter->GetFrameMode() == vtkTetrahedraRayIntegral::CAMERA)
  {
    vtkCamera* camera = filter->GetCamera();
    const glm::dvec3 eye = ToVector(camera->GetPosition());
    const glm::dvec3 forward = glm::normalize(ToVector(camera->GetFocalPoint()) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, ToVector(camera->GetViewUp())));
    const double slope = std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle()));
    const glm::dvec3 direction = forward +
      slope *
        ((2.0 * across - 1.0) * size[0] / size[1] * right +
          (2.0 * upward - 1.0) * glm::cross(right, forward));
    return { eye, glm::normalize(direction) };
  }
  const glm::dvec3 axis1 = ToVector(filter->GetFrameAxis1());
  const glm::dvec3 axis2 = ToVector(filter->GetFrameAxis2());
  return { ToVector(filter->GetFrameOrigin()) + across * axis1 + upward * axis2,
    glm::normalize(glm::cross(axis2, axis1)) };
}

//------------------------------------------------------------------------------
std::vector<double> ValuesOf(vtkTetrahedraRayIntegral* filter, const char* name)
{
  filter->Update();
  vtkDataArray* array = filter->GetOutput()->GetPointData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      values.push_back(array->GetComponent(i, component));
    }
  }
  return values;
}

//------------------------------------------------------------------------------
double WorstError(vtkTetrahedraRayIntegral* filter, const char* name,
  const std::function<double(const WorldRay&)>& truth)
{
  const std::vector<double> values = ValuesOf(filter, name);
  const int* size = filter->GetImageSize();
  if (values.size() != static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]))
  {
    return 1.0e30;
  }
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto pixel = static_cast<int>(i);
    const double expected = truth(RayOf(filter, pixel % size[0], pixel / size[0]));
    if (std::isinf(expected))
    {
      continue;
    }
    if (std::isnan(expected) != std::isnan(values[i]))
    {
      return 1.0e30;
    }
    if (!std::isnan(expected))
    {
      worst = std::max(worst, std::abs(values[i] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  return largest > 0.0 ? worst / largest : 1.0e30;
}

//------------------------------------------------------------------------------
double IntegrateCells(vtkUnstructuredGrid* grid, bool scalars)
{
  vtkDataArray* values = grid->GetPointData()->GetScalars();
  double sum = 0.0;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    vtkIdList* ids = grid->GetCell(i)->GetPointIds();
    glm::dvec3 corners[4];
    double mean = scalars ? 0.0 : 1.0;
    for (int k = 0; k < 4; ++k)
    {
      corners[k] = ToVector(grid->GetPoint(ids->GetId(k)));
      mean += scalars ? 0.25 * values->GetTuple1(ids->GetId(k)) : 0.0;
    }
    const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    sum += mean * std::abs(glm::dot(across, corners[3] - corners[0])) / 6.0;
  }
  return sum;
}

} // namespace meniscus::test
