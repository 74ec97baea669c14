// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <glm/vec3.hpp>

#include <array>

namespace meniscus
{

/** Control points of a patch's normal, which is a Bezier triangle of second degree. */
std::array<glm::dvec3, 6> ComputeNormalControls(const CurvedPatch& patch);

/** Bound of the distance between a point of a patch and the same point of its facet. */
double BoundBulge(const CurvedPatch& patch);

/**
 * Bounds of the position of a patch's points along their normals, from the points of the facet;
 * Below is not positive, and Above not negative.
 */
struct BulgeBounds
{
  double Below;
  double Above;
};
BulgeBounds BoundBulges(const CurvedPatch& patch);

/**
 * Unit vectors within `half` of `middle`, component by component. The default holds all unit
 * vectors.
 */
struct DirectionBox
{
  glm::dvec3 Middle{ 0.0 };
  glm::dvec3 Half{ 1.0 };
};

/** Bounds of the unit vectors along all vectors within `reach` of the hull of `count` vectors. */
DirectionBox BoundDirections(
  const glm::dvec3& middle, const glm::dvec3* hull, int count, double reach);

/** Bounds of the unit normals of a patch. */
DirectionBox BoundNormals(const CurvedPatch& patch);

/** Bounds of the cosine of the angle between two directions. */
struct CosineBounds
{
  double Least;
  double Most;
};
CosineBounds BoundCosine(const DirectionBox& sight, const DirectionBox& normal);

/**
 * Tube around rays with directions in a box and starts within `reach` of the hull of `count`
 * points.
 */
TubeBounds BoundRays(const glm::dvec3& lowest, const glm::dvec3& highest, const glm::dvec3* points,
  int count, double reach);

/**
 * Tube around every ray that Snell's law refracts within `reach` of the hull of `count` points, for
 * sight rays and normals in the given boxes; otherwise as the overload below.
 */
TubeBounds BoundRefractedRays(const DirectionBox& sight, const DirectionBox& normal, double ratio,
  const glm::dvec3* points, int count, double reach);

/**
 * Tube around every ray that Snell's law refracts at a point of `patch`. It is not valid if there
 * is none: if the entire patch faces away from the eye or reflects totally. `ratio` is n1 / n2.
 *
 * It uses interval arithmetic on Eq. 2.2 in the form R = ratio D + g(c) N with c = D.N. D, N and c
 * are boxes about the patch's middle and g is monotonic in c, so no ray is outside, whatever the
 * patch's shape.
 */
TubeBounds BoundRefractedRays(const CurvedPatch& patch, const glm::dvec3& eye, double ratio);

/**
 * Tube around every ray that a point of `patch` reflects, by the same arithmetic with ratio 1 and
 * g(c) = -2 c. It is not valid if the entire patch faces away from the eye.
 */
TubeBounds BoundReflectedRays(const CurvedPatch& patch, const glm::dvec3& eye);

}
