// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Tubes_RefractedRayBounds_h
#define meniscus_Refraction_Tubes_RefractedRayBounds_h

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Tubes/RayTubeTree.h"

namespace meniscus
{

/** Longest distance between the points of a patch and those of its facet. */
double BoundBulge(const CurvedPatch& patch);

/** Unit vectors within `half` of `middle`, component by component; any at all by default. */
struct DirectionBox
{
  glm::dvec3 Middle{ 0.0 };
  glm::dvec3 Half{ 1.0 };
};

/** About the unit vectors along what is within `reach` of the hull of `count` vectors. */
DirectionBox BoundDirections(
  const glm::dvec3& middle, const glm::dvec3* hull, int count, double reach);

/** About the unit normals of a patch. */
DirectionBox BoundNormals(const CurvedPatch& patch);

/** Bounds of the cosine of two directions. */
struct CosineBounds
{
  double Least;
  double Most;
};
CosineBounds BoundCosine(const DirectionBox& sight, const DirectionBox& normal);

/** A tube around rays of directions in a box from within `reach` of the hull of `count` points. */
TubeBounds BoundRays(const glm::dvec3& lowest, const glm::dvec3& highest, const glm::dvec3* points,
  int count, double reach);

/**
 * A tube around every ray that Snell's law refracts within `reach` of the hull of `count` points,
 * for sight rays and normals of the boxes; else as below.
 */
TubeBounds BoundRefractedRays(const DirectionBox& sight, const DirectionBox& normal, double ratio,
  const glm::dvec3* points, int count, double reach);

/**
 * A tube around every ray that Snell's law refracts at a point of `patch`, not valid where there is
 * none: where all of the patch faces away from the eye or reflects totally. `ratio` is n1 / n2.
 *
 * By intervals, in the form of Eq. 2.2: R = ratio D + g(c) N with c = D.N. D, N and c are boxes
 * about the patch's middle, g is monotonic in c, so no ray is outside whatever the patch's shape.
 */
TubeBounds BoundRefractedRays(const CurvedPatch& patch, const glm::dvec3& eye, double ratio);

}

#endif
