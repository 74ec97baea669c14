// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>

namespace meniscus
{

/** Array with a name and a size; its values are not set. */
template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, int components, std::size_t tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

/** Adds such an array to the points of a data set, with a tuple for each. */
template <typename Array>
Array* AddPointArray(vtkDataSet* data, const char* name, int components)
{
  const auto array =
    MakeArray<Array>(name, components, static_cast<std::size_t>(data->GetNumberOfPoints()));
  data->GetPointData()->AddArray(array);
  return array;
}

}
