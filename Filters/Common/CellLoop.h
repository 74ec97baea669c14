// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkSmartPointer.h"

namespace meniscus
{

/** Calls `body(number of points, point ids)` for the cells of a list, one after another. */
template <typename Body>
void ForEachCell(vtkCellArray* cells, Body&& body)
{
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    iterator->GetCurrentCell(count, ids);
    body(count, ids);
  }
}

}
