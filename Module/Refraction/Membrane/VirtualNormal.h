// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Normals for the lighting of virtual geometry. Diffuse light is N.w, with w the direction to the
 * light at the true point, and highlights depend on N.v too, with v the direction to the viewer.
 * Both are those of refracted rays there. At the virtual point they are w' and v', those of
 * straight ones, so a normal n with n.w' = N.w and n.v' = N.v is lit as the true one is.
 */
#ifndef meniscus_Refraction_Membrane_VirtualNormal_h
#define meniscus_Refraction_Membrane_VirtualNormal_h

#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

/**
 * `normal`, turned with the shortest turn of the unit vector `from` to `to`, which are less than a
 * right angle apart.
 */
inline glm::dvec3 TurnAlong(const glm::dvec3& normal, const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dvec3 axis = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  return cosine * normal + glm::cross(axis, normal) +
    axis * (glm::dot(axis, normal) / (1.0 + cosine));
}

/** Directions at a point, unit vectors away from it. */
struct LitPoint
{
  glm::dvec3 View;
  glm::dvec3 Light;
};

/**
 * The unit normal with the products of `normal`. Where no unit vector has both, it has the product
 * with the light, and the nearest one with the view; where view and light have become one, the
 * product with the view.
 */
inline glm::dvec3 KeepLighting(
  const glm::dvec3& normal, const LitPoint& atTrue, const LitPoint& atVirtual)
{
  // Below this sine the two products no longer tell a direction: rounding of 1e-16 over its square.
  constexpr double smallestSine = 1e-5;
  const double p = glm::dot(normal, atTrue.View);
  const double q = glm::dot(normal, atTrue.Light);
  const double g = glm::dot(atVirtual.View, atVirtual.Light);
  const glm::dvec3 across = glm::cross(atVirtual.View, atVirtual.Light);
  const double squared = glm::dot(across, across); // 1 - g g, without its cancellation
  if (squared < smallestSine * smallestSine)
  {
    return TurnAlong(normal, atTrue.View, atVirtual.View);
  }
  const glm::dvec3 inPlane =
    ((p - g * q) / squared) * atVirtual.View + ((q - g * p) / squared) * atVirtual.Light;
  const double rest = 1.0 - glm::dot(inPlane, inPlane);
  if (rest <= 0.0)
  {
    const double sine = std::sqrt(std::max(1.0 - q * q, 0.0));
    const glm::dvec3 beside = (atVirtual.View - g * atVirtual.Light) / std::sqrt(squared);
    return q * atVirtual.Light + (p < g * q ? -sine : sine) * beside;
  }
  const double side = glm::dot(normal, glm::cross(atTrue.View, atTrue.Light));
  return glm::normalize(inPlane + across * std::copysign(std::sqrt(rest / squared), side));
}

/**
 * The normal at the virtual point `position` of the true point `point`. `light` is the direction to
 * a light at infinity outside the membrane; null for a light at the eye. The membrane counts as
 * plane about the sight point for the light's ray; where that is in the shade of the membrane, or
 * reflected by all of it, the normal points away from the light.
 */
inline glm::dvec3 ComputeVirtualNormal(const glm::dvec3& normal, const glm::dvec3& point,
  const glm::dvec3& sightPoint, const glm::dvec3& eye, double exterior, double interior,
  const glm::dvec3* light)
{
  const glm::dvec3 inside = sightPoint - point;
  const double depth = glm::length(inside);
  if (exterior == interior || !(depth > 0.0))
  {
    return normal;
  }
  LitPoint atTrue;
  LitPoint atVirtual;
  atTrue.View = inside / depth;
  atVirtual.View = glm::normalize(eye - sightPoint); // the virtual point is on this ray
  if (!light)
  {
    return TurnAlong(normal, atTrue.View, atVirtual.View);
  }
  // By Snell's law the tangential parts of n1 d and n2 r are the same: the rest is the normal.
  glm::dvec3 surface = exterior * atVirtual.View - interior * atTrue.View;
  surface *= (glm::dot(surface, atVirtual.View) < 0.0 ? -1.0 : 1.0) / glm::length(surface);
  const RefractionRay ray = ComputeRefractionRay(-*light, surface, exterior / interior);
  if (ray.Kind != RayKind::Refracted)
  {
    return -*light;
  }
  atTrue.Light = -ray.Direction;
  atVirtual.Light = *light;
  return KeepLighting(normal, atTrue, atVirtual);
}

}

#endif
