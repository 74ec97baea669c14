// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/PointEyes.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace meniscus
{

//------------------------------------------------------------------------------
std::string PointEyes::UseArray(vtkPointSet* points, const std::string& name)
{
  if (name.empty())
  {
    return std::string();
  }
  this->Array = points->GetPointData()->GetArray(name.c_str());
  if (this->Array && this->Array->GetNumberOfComponents() == 3)
  {
    return std::string();
  }
  this->Array = nullptr;
  return "The points have no array \"" + name + "\" with three components for the eyes";
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> PointEyes::GetSample(vtkIdType count) const
{
  constexpr vtkIdType most = 256;
  std::vector<glm::dvec3> eyes;
  const vtkIdType stride = this->Array ? (count + most - 1) / most : count;
  for (vtkIdType i = 0; i < count; i += stride)
  {
    eyes.push_back(this->Get(i));
  }
  return eyes;
}

}
