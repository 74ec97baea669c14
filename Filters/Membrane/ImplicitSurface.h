// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Membrane/Membrane.h"

class vtkImplicitFunction;

namespace meniscus
{

/** The zero set of an implicit function as the exact surface of a membrane. */
class ImplicitSurface
{
public:
  /** Rays come from the side to which most normals of `membrane` point. */
  ImplicitSurface(vtkImplicitFunction* function, const Membrane& membrane);

  /**
   * Intersection of the ray from `origin` along the unit vector `direction` near the point `near`,
   * and the unit normal there, against the ray, by Newton's method along the ray. Returns false if
   * there is none. Thread-safe if the function is.
   */
  bool Meet(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& near,
    PatchPoint& at) const;

  /** Turns the surface over: rays come from its other side. */
  void Turn() { this->Sign = -this->Sign; }

private:
  glm::dvec3 GetGradient(const glm::dvec3& at) const;

  vtkImplicitFunction* Function;
  double Sign = 1.0;
};

}
