// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Sight_ExactSurface_h
#define meniscus_Refraction_Sight_ExactSurface_h

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Sight/VirtualVertex.h"

#include <glm/vec3.hpp>

namespace meniscus
{

/** The exact surface that a membrane's mesh approximates, in world coordinates. */
class ExactSurface
{
public:
  virtual ~ExactSurface() = default;

  /**
   * Intersection of the ray from the eye along the unit vector `direction` with the surface near
   * `vertex.SightPoint`, and the unit normal there, on the eye's side. Returns false if there is
   * none.
   */
  virtual bool Meet(const glm::dvec3& point, const VirtualVertex& vertex,
    const glm::dvec3& direction, PatchPoint& at) const = 0;
};

}

#endif
