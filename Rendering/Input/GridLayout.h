// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Properties of VTK's data sets and arrays that decide how they are read.
#pragma once

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <cstddef>
#include <vector>

namespace meniscus
{

template <typename T>
std::vector<T> CopyValues(vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  std::vector<T> values(components * array->GetNumberOfTuples());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<T>(array->GetComponent(
      static_cast<vtkIdType>(i / components), static_cast<int>(i % components)));
  }
  return values;
}

/** True if the class of the data set guarantees that all cells have one type. */
inline bool HasOneType(vtkDataSet* grid)
{
  return vtkImageData::SafeDownCast(grid) || vtkRectilinearGrid::SafeDownCast(grid) ||
    vtkStructuredGrid::SafeDownCast(grid);
}

/** True if several threads may read cells at the same time. */
inline bool IsThreadSafe(vtkDataSet* grid)
{
  return HasOneType(grid) || vtkUnstructuredGrid::SafeDownCast(grid);
}

}
