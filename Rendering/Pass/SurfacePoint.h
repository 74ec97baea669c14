// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkPolyData.h"
#include "vtkType.h"

#include <glm/vec3.hpp>

namespace meniscus
{

inline glm::dvec3 PointOf(vtkPolyData* data, vtkIdType i)
{
  glm::dvec3 point;
  data->GetPoint(i, &point.x);
  return point;
}

}
