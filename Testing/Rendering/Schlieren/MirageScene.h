// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Small pictures of mirages. */
#pragma once

#include "HardMeshes.h"
#include "RayCastScene.h"

#include <vtkTetrahedraMirage.h>

#include <glm/gtc/type_ptr.hpp>

namespace meniscus::test
{

using Filter = vtkSmartPointer<vtkTetrahedraMirage>;
using Object = vtkSmartPointer<vtkPolyData>;

/** Pixels of a picture along each axis. */
constexpr int Size = 40;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

inline Object MakePlane(double z, double half)
{
  const auto plane = MakePlane(half, z, 1);
  plane->SetResolution(7, 5);
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->Update();
  return plane->GetOutput();
}

inline Filter MakeFilter(vtkDataObject* mesh, vtkDataSet* objects)
{
  auto filter = Filter::New();
  filter->SetInputDataObject(mesh);
  filter->SetObjectData(objects);
  filter->SetQuantityToRefractiveIndex();
  filter->SetImageSize(Size, Size);
  return filter;
}

inline vtkSmartPointer<vtkCamera> MakeCamera(
  const glm::dvec3& eye, const glm::dvec3& focus, double tangent)
{
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(focus.x, focus.y, focus.z);
  camera->SetViewAngle(2.0 * std::atan(tangent) * 180.0 / M_PI);
  return camera;
}

inline vtkDataArray* ArrayOf(vtkTetrahedraMirage* filter, const char* name)
{
  return filter->GetOutput()->GetPointData()->GetArray(name);
}

inline double ValueAt(vtkTetrahedraMirage* filter, const char* name, vtkIdType pixel, int part = 0)
{
  return ArrayOf(filter, name)->GetComponent(pixel, part);
}

inline glm::dvec3 VectorAt(vtkTetrahedraMirage* filter, const char* name, vtkIdType pixel)
{
  glm::dvec3 value;
  ArrayOf(filter, name)->GetTuple(pixel, glm::value_ptr(value));
  return value;
}

}
