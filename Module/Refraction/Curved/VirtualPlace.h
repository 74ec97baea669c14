// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Sight/SightEquation.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace meniscus
{

/** Place where a point is seen, relative to the membrane's origin, as members of VirtualVertex. */
struct VirtualPlace
{
  glm::dvec3 Position;
  double Depth;
  double Reflectance;
  double Cosine;
};

/**
 * Place where the eye sees `point` through the sight point `at`. `law` is media.GetLaw(). With
 * equal indices of refraction, Position is the point up to rounding.
 */
inline VirtualPlace ComputeVirtualPlace(
  const Media& media, const Media& law, const glm::dvec3& point, const PatchPoint& at)
{
  const glm::dvec3 sight = glm::normalize(at.Position - media.Eye);
  VirtualPlace place;
  place.Depth = glm::length(point - at.Position);
  // Eq. 2.4
  place.Position = at.Position + sight * (place.Depth * law.Exterior / law.Interior);
  place.Cosine = -glm::dot(sight, at.Normal) / glm::length(at.Normal);
  place.Reflectance = FresnelReflectance(place.Cosine, media.Exterior, media.Interior);
  return place;
}

}
