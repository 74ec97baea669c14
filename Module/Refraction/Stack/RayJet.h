// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A ray with its derivatives by two parameters, and their way through one interface: transfer to a
 * surface and refraction there (ray differentials, Igehy 1999).
 */
#ifndef meniscus_Refraction_Stack_RayJet_h
#define meniscus_Refraction_Stack_RayJet_h

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace meniscus
{

/** A ray, its unit direction, and the derivatives of both. */
struct RayJet
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;
  glm::dvec3 OriginBy[2];
  glm::dvec3 DirectionBy[2];
};

/** Ray from the eye to a point of a patch, differentiated by the place in the patch. */
inline RayJet MakeSightRay(const glm::dvec3& eye, const PatchJet& at)
{
  const glm::dvec3 away = at.Position - eye;
  const double inverse = 1.0 / glm::length(away);
  RayJet ray;
  ray.Origin = at.Position;
  ray.Direction = inverse * away;
  for (int k = 0; k < 2; ++k)
  {
    ray.OriginBy[k] = at.PositionBy[k];
    ray.DirectionBy[k] =
      inverse * (at.PositionBy[k] - ray.Direction * glm::dot(ray.Direction, at.PositionBy[k]));
  }
  return ray;
}

/**
 * Moves the origin along the ray to the patch, which it meets at `at`. Returns in `placeBy` the
 * derivatives of the place in the patch, and in `normalBy` those of its normal.
 */
inline void Transfer(RayJet& ray, const PatchJet& at, glm::dvec2 placeBy[2], glm::dvec3 normalBy[2])
{
  const double distance = glm::dot(at.Position - ray.Origin, ray.Direction);
  // Cramer's rule for u by0 + v by1 - t direction = change of the ray at this distance.
  const glm::dvec3 across = glm::cross(at.PositionBy[1], ray.Direction);
  const double inverse = 1.0 / glm::dot(at.PositionBy[0], across);
  for (int k = 0; k < 2; ++k)
  {
    const glm::dvec3 change = ray.OriginBy[k] + distance * ray.DirectionBy[k];
    const double u = inverse * glm::dot(change, across);
    const double v = inverse * glm::dot(at.PositionBy[0], glm::cross(change, ray.Direction));
    placeBy[k] = { u, v };
    ray.OriginBy[k] = u * at.PositionBy[0] + v * at.PositionBy[1];
    normalBy[k] = u * at.NormalBy[0] + v * at.NormalBy[1];
  }
  ray.Origin = at.Position;
}

/**
 * Refracts the ray at its origin, by Eq. 2.2 with `ratio` = n1 / n2: R = ratio D + g N with g =
 * -ratio c - sqrt(1 - ratio^2 (1 - c^2)) and c = D.N. The normal need not be normalised. Returns
 * RayKind::Refracted and sets `cosine` to -c, or changes nothing: beyond the critical angle, and
 * where the normal is too short or points along the ray.
 */
inline RayKind Refract(
  RayJet& ray, const glm::dvec3& normal, const glm::dvec3 normalBy[2], double ratio, double& cosine)
{
  const double length = glm::length(normal);
  const double perLength = 1.0 / length;
  const glm::dvec3 n = perLength * normal;
  const double c = glm::dot(ray.Direction, n);
  // Written so that a NaN fails.
  if (!(c < 0.0 && length > CurvedPatch::ShortestNormal))
  {
    return RayKind::BackFacing;
  }
  const double radicand = RefractionRadicand(c, ratio);
  if (!(radicand > 0.0))
  {
    return RayKind::TotallyReflected; // also at the critical angle, where derivatives are infinite
  }
  const double root = std::sqrt(radicand);
  const double g = -ratio * c - root;
  const double gByCosine = -ratio - ratio * ratio * c / root;
  for (int k = 0; k < 2; ++k)
  {
    const glm::dvec3 nBy = perLength * (normalBy[k] - n * glm::dot(n, normalBy[k]));
    const double cBy = glm::dot(ray.DirectionBy[k], n) + glm::dot(ray.Direction, nBy);
    ray.DirectionBy[k] = ratio * ray.DirectionBy[k] + gByCosine * cBy * n + g * nBy;
  }
  // The length is 1 within rounding, as are those of the vectors that it is made of.
  ray.Direction = ratio * ray.Direction + g * n;
  cosine = -c;
  return RayKind::Refracted;
}

}

#endif
