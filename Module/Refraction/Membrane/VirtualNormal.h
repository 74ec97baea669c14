// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Normals for the lighting of virtual geometry. Diffuse light is N.w, with w the direction to the
 * light at the true point; highlights also depend on N.v, with v the direction to the viewer. At
 * the true point, both are directions of refracted rays. At the virtual point the corresponding
 * directions w' and v' belong to straight rays, so a normal n with n.w' = N.w and n.v' = N.v
 * receives the same lighting as the true one.
 */
#pragma once

#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

/**
 * Rotates `normal` by the smallest rotation that takes the unit vector `from` to `to`; the two must
 * be less than a right angle apart.
 */
inline glm::dvec3 TurnAlong(const glm::dvec3& normal, const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dvec3 axis = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  return cosine * normal + glm::cross(axis, normal) +
    axis * (glm::dot(axis, normal) / (1.0 + cosine));
}

/** Directions to the viewer and to the light at a point: unit vectors away from it. */
struct LitPoint
{
  glm::dvec3 View;
  glm::dvec3 Light;
};

/**
 * Unit normal with the same dot products with light and view as `normal`. Where no unit vector has
 * both, the result has the product with the light and is nearest to the product with the view;
 * where view and light coincide, it has the product with the view.
 */
inline glm::dvec3 KeepLighting(
  const glm::dvec3& normal, const LitPoint& atTrue, const LitPoint& atVirtual)
{
  // Below this sine the two products do not determine a direction: rounding of 1e-16 over its
  // square.
  constexpr double smallestSine = 1e-5;
  const double p = glm::dot(normal, atTrue.View);
  const double q = glm::dot(normal, atTrue.Light);
  const double g = glm::dot(atVirtual.View, atVirtual.Light);
  const glm::dvec3 across = glm::cross(atVirtual.View, atVirtual.Light);
  const double squared = glm::dot(across, across); // 1 - g g, without its cancellation error
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
 * Normal at the virtual point `position` of the true point `point`. `light` is the direction to a
 * light at infinity outside the membrane; null for a light at the eye. For the light's ray the
 * membrane is approximated by the tangent plane at the sight point. Where the light is behind this
 * plane, or totally reflected by it, the normal points away from the light.
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
  // By Snell's law the tangential parts of n1 d and n2 r are equal, so their difference is along
  // the normal.
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

/**
 * Normal of the mirror image of a point with the unit normal `normal`: mirrored at the tangent
 * plane of the sight point. The light is mirrored with it.
 */
inline glm::dvec3 ComputeMirroredNormal(const glm::dvec3& normal, const glm::dvec3& point,
  const glm::dvec3& sightPoint, const glm::dvec3& eye)
{
  const glm::dvec3 back = point - sightPoint;
  const double depth = glm::length(back);
  if (!(depth > 0.0))
  {
    return normal;
  }
  // By the law of reflection the mirror's normal halves the angle between eye and point.
  const glm::dvec3 across = glm::normalize(back / depth + glm::normalize(eye - sightPoint));
  return normal - (2.0 * glm::dot(normal, across)) * across;
}

/**
 * Normal at the mirror image `position` of a point for light that comes to the point directly, not
 * by the mirror; otherwise as ComputeVirtualNormal. A null `light` is at the eye.
 */
inline glm::dvec3 ComputeReflectedNormal(const glm::dvec3& normal, const glm::dvec3& point,
  const glm::dvec3& sightPoint, const glm::dvec3& eye, const glm::dvec3* light)
{
  const glm::dvec3 inFront = sightPoint - point;
  const double depth = glm::length(inFront);
  const glm::dvec3 view = glm::normalize(eye - sightPoint); // the virtual point is on this ray
  if (!(depth > 0.0))
  {
    return normal;
  }
  if (!light)
  {
    // The virtual point is lit along the line of sight, so only the light's product can be kept.
    const glm::dvec3 mirrored = ComputeMirroredNormal(normal, point, sightPoint, eye);
    const double q = glm::dot(normal, glm::normalize(eye - point));
    const glm::dvec3 beside = mirrored - glm::dot(mirrored, view) * view;
    const double length = glm::length(beside);
    const double sine = std::sqrt(std::max(1.0 - q * q, 0.0));
    return length > 0.0 ? q * view + (sine / length) * beside : mirrored;
  }
  return KeepLighting(normal, { inFront / depth, *light }, { view, *light });
}

}
