// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkCellArray.h"
#include "vtkContourTriangulator.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"

namespace meniscus
{

/**
 * Divides a polygon that touches itself, as along the bridge between a border and a hole, which
 * vtkTriangleFilter leaves out. Calls `add(ids)` with the three points of each triangle; returns
 * false if the polygon cannot be divided.
 */
template <typename Add>
bool DivideTouchingPolygon(
  vtkPoints* points, vtkIdType count, const vtkIdType* corners, const Add& add)
{
  vtkNew<vtkIdList> polygon;
  for (vtkIdType i = 0; i < count; ++i)
  {
    polygon->InsertNextId(corners[i]);
  }
  vtkNew<vtkCellArray> triangles;
  vtkContourTriangulator::TriangulatePolygon(polygon, points, triangles);
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
  {
    vtkIdType three = 0;
    const vtkIdType* ids = nullptr;
    triangles->GetCellAtId(i, three, ids);
    add(ids);
  }
  return triangles->GetNumberOfCells() > 0;
}

}
