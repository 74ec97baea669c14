// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkPointSet.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

namespace meniscus
{

/** Coordinates x, y and z of all points in turn. */
inline std::vector<double> CopyPoints(vtkPointSet* input)
{
  const vtkIdType count = input->GetNumberOfPoints();
  std::vector<double> points(3 * static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    input->GetPoint(i, points.data() + 3 * i);
  }
  return points;
}

}
