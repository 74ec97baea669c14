// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A ray with its derivatives by two parameters, and their way through one interface: transfer to a
 * surface and refraction there (ray differentials, Igehy 1999).
 */
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Membrane/Optics.h"
#include "Refraction/Stack/VectorBy.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace meniscus
{

/** A ray, its unit direction, and the derivatives of both. */
struct RayJet
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;
  VectorBy OriginBy;
  VectorBy DirectionBy;
};

/** Ray from the eye to a point of a patch, differentiated by the place in the patch. */
inline RayJet MakeSightRay(const glm::dvec3& eye, const PatchJet& at)
{
  const glm::dvec3 away = at.Position - eye;
  const double inverse = 1.0 / glm::length(away);
  RayJet ray;
  ray.Origin = at.Position;
  ray.Direction = inverse * away;
  ray.OriginBy = MakeVectorBy(at.PositionBy);
  ray.DirectionBy = inverse * (ray.OriginBy - ray.Direction * Dot(ray.Direction, ray.OriginBy));
  return ray;
}

/**
 * Place in the tangent plane of a patch as a function of the point of a ray that meets it: the
 * change of each of its coordinates is the scalar product with the change of the point.
 */
struct PlaceGradient
{
  glm::dvec3 U;
  glm::dvec3 V;
};

/** Cramer's rule for u by0 + v by1 - t direction = change of the ray's point. */
inline PlaceGradient GetPlaceGradient(const PatchJet& at, const glm::dvec3& direction)
{
  const glm::dvec3 across = glm::cross(at.PositionBy[1], direction);
  const double inverse = 1.0 / glm::dot(at.PositionBy[0], across);
  return { inverse * across, inverse * glm::cross(direction, at.PositionBy[0]) };
}

/** Derivatives of a place in a patch. */
struct PlaceBy
{
  NumberBy U{ 0.0, 0.0 };
  NumberBy V{ 0.0, 0.0 };
};

inline glm::dvec2 GetChange(const PlaceBy& by, const glm::dvec2& move)
{
  return { GetChange(by.U, move), GetChange(by.V, move) };
}

/** Derivatives of a vector that depends on a place, by the parameters that the place depends on. */
inline VectorBy Chain(const glm::dvec3 by[2], const PlaceBy& place)
{
  return by[0] * place.U + by[1] * place.V;
}

/**
 * Moves the origin along the ray to the patch, which it meets at `at` with the gradient of the
 * place there. Returns the derivatives of the place in the patch.
 */
inline PlaceBy Transfer(RayJet& ray, const PatchJet& at, const PlaceGradient& gradient)
{
  const double distance = glm::dot(at.Position - ray.Origin, ray.Direction);
  const VectorBy change = ray.OriginBy + distance * ray.DirectionBy;
  const PlaceBy place{ Dot(gradient.U, change), Dot(gradient.V, change) };
  ray.OriginBy = Chain(at.PositionBy, place);
  ray.Origin = at.Position;
  return place;
}

/**
 * Refracts the ray at its origin, by Eq. 2.2 with `ratio` = n1 / n2: R = ratio D + g N with g =
 * -ratio c - sqrt(1 - ratio^2 (1 - c^2)) and c = D.N. The normal need not be normalised. Returns
 * RayKind::Refracted and sets `cosine` to -c, or changes nothing: beyond the critical angle, and
 * where the normal is too short or points along the ray.
 */
inline RayKind Refract(
  RayJet& ray, const glm::dvec3& normal, const VectorBy& normalBy, double ratio, double& cosine)
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
  // The derivatives of N are perLength (normalBy - N along), the derivatives of c are cBy.
  const NumberBy along = Dot(n, normalBy);
  const NumberBy cBy =
    Dot(n, ray.DirectionBy) + perLength * (Dot(ray.Direction, normalBy) - c * along);
  const double turn = g * perLength;
  ray.DirectionBy =
    ratio * ray.DirectionBy + turn * normalBy + n * (gByCosine * cBy - turn * along);
  // The vectors in this sum have unit length within rounding, and so has the result.
  ray.Direction = ratio * ray.Direction + g * n;
  cosine = -c;
  return RayKind::Refracted;
}

}
