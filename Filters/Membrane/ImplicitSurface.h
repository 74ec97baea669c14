// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Membrane_ImplicitSurface_h
#define meniscus_Filters_Membrane_ImplicitSurface_h

#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Sight/ExactSurface.h"

class vtkImplicitFunction;

namespace meniscus
{

/** The zero set of an implicit function as the exact surface of a membrane. */
class ImplicitSurface : public ExactSurface
{
public:
  /** The eye's side is the one to which most normals of `membrane` point. */
  ImplicitSurface(vtkImplicitFunction* function, const Membrane& membrane, const glm::dvec3& eye);

  /**
   * Newton's method along the ray, starting from the sight point. Thread-safe if the function is.
   */
  bool Meet(const glm::dvec3& point, const VirtualVertex& vertex, const glm::dvec3& direction,
    PatchPoint& at) const override;

  /** As Meet, for a ray from `origin` that meets the surface near `near`. */
  bool MeetNear(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& near,
    PatchPoint& at) const;

  /** Makes the other side of the surface the one that rays come from. */
  void Turn() { this->Sign = -this->Sign; }

private:
  glm::dvec3 GetGradient(const glm::dvec3& at) const;

  vtkImplicitFunction* Function;
  glm::dvec3 Eye;
  double Sign = 1.0;
};

}

#endif
