// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapScene.h"

namespace meniscus::test
{

namespace
{

glm::dvec3 VectorBy(const glm::dmat4& map, const glm::dvec3& v)
{
  return glm::dvec3(map * glm::dvec4(v, 0.0));
}

// The winding of a membrane's triangles is reversed where the map mirrors, so that they face where
// its normals do.
vtkSmartPointer<vtkPolyData> Mapped(vtkPolyData* membrane, const glm::dmat4& map)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->DeepCopy(membrane);
  vtkDataArray* normals = result->GetPointData()->GetNormals();
  const double length = glm::length(VectorBy(map, glm::dvec3(1.0, 0.0, 0.0)));
  for (vtkIdType i = 0; i < result->GetNumberOfPoints(); ++i)
  {
    const double* x = result->GetPoint(i);
    const glm::dvec3 moved = PointBy(map, glm::dvec3(x[0], x[1], x[2]));
    result->GetPoints()->SetPoint(i, &moved[0]);
    const glm::dvec3 n = TupleOf(normals, i);
    const glm::dvec3 turned = VectorBy(map, glm::dvec3(n[0], n[1], n[2])) / length;
    normals->SetTuple(i, &turned[0]);
  }
  if (glm::determinant(map) < 0.0)
  {
    for (vtkIdType c = 0; c < result->GetNumberOfCells(); ++c)
    {
      result->ReverseCell(c);
    }
  }
  return result;
}

} // anonymous namespace

//------------------------------------------------------------------------------
glm::dvec3 PointBy(const glm::dmat4& map, const glm::dvec3& p)
{
  return glm::dvec3(map * glm::dvec4(p, 1.0));
}

//------------------------------------------------------------------------------
void MapScene(VolumeCase& test, const glm::dmat4& map)
{
  const double scale = glm::length(VectorBy(map, glm::dvec3(1.0, 0.0, 0.0)));
  for (MeshArrays& mesh : test.Blocks)
  {
    for (glm::dvec3& p : mesh.Points)
    {
      p = PointBy(map, p);
    }
  }
  VolumeView& view = test.View;
  view.Eye = PointBy(map, view.Eye);
  view.Focus = PointBy(map, view.Focus);
  view.Up = VectorBy(map, view.Up) / scale;
  view.Near *= scale;
  view.Far *= scale;
  view.HalfHeight *= view.Parallel ? scale : 1.0;
  if (test.Membrane.Mesh)
  {
    test.Membrane.Mesh = Mapped(test.Membrane.Mesh, map);
  }
  MapScalars(test.Look, 1.0, 0.0, scale);
}

} // namespace meniscus::test
