// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataArray.h"
#include "vtkType.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkPointSet;

namespace meniscus
{

/** The eyes that see the points of a data set: one for all points, or one for each. */
class PointEyes
{
public:
  PointEyes() = default;

  /** One eye for all points. */
  explicit PointEyes(const double eye[3])
    : Eye(eye[0], eye[1], eye[2])
  {
  }

  /**
   * Uses the point array `name` of the points, which has the three coordinates of each eye. An
   * empty name changes nothing. Returns the text of an error; empty if there is none.
   */
  std::string UseArray(vtkPointSet* points, const std::string& name);

  bool IsPerPoint() const { return this->Array != nullptr; }

  /** The eye of point `i`. May be called from several threads. */
  glm::dvec3 Get(vtkIdType i) const
  {
    glm::dvec3 eye = this->Eye;
    if (this->Array)
    {
      this->Array->GetTuple(i, &eye.x);
    }
    return eye;
  }

  /** Eyes of up to 256 of `count` points; all if there are no more. */
  std::vector<glm::dvec3> GetSample(vtkIdType count) const;

private:
  glm::dvec3 Eye{ 0.0 };
  vtkDataArray* Array = nullptr;
};

}
