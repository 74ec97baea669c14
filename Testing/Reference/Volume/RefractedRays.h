// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays that are refracted at a surface, in double precision, and the mesh along them: the input of
 * the integrators for a volume that is seen through a membrane. Surfaces are formulas, and Snell's
 * law is n1 sin a = n2 sin b, independently of the kernel's patches and optics.
 */
#pragma once

#include "ReferenceRayIntegrator.h"

#include <functional>
#include <vector>

namespace meniscus::reference
{

struct RefractingSurface
{
  /** True if a point of the infinite surface belongs to it. */
  std::function<bool(const Vector3&)> Has = [](const Vector3&) { return true; };
  /** All parameters at which a ray with a direction of unit length meets the infinite surface. */
  std::function<std::vector<double>(const Ray&)> Meet;
  /** Unit normal at a point of it, towards the exterior. */
  std::function<Vector3(const Vector3&)> Normal;
  double Exterior = 1.0;
  double Interior = 1.333;
};

/** The plane through a point. */
RefractingSurface MakePlane(const Vector3& origin, const Vector3& normal);
/** The sphere, with outward normals. */
RefractingSurface MakeSphere(const Vector3& center, double radius);
/**
 * The height field y = level + amplitude sin(k x) sin(k z), with upward normals. Pairs of
 * intersections closer to each other than 1 / 64 of a wave may be missed.
 */
RefractingSurface MakeWaves(double level, double amplitude, double k);

/** A ray in front of the surface and behind it; directions have unit length. */
struct RefractedRay
{
  Ray Straight;
  /** Begin >= End if the ray does not meet the surface, or is totally reflected. */
  Ray Bent;
};

/**
 * @param eye parameter of the ray at the eye; the ray's Begin is the near plane.
 * @param endsOpaque true: opaque geometry is drawn at the ray's End, which behind the surface
 *   corresponds to the place given by Eq. 2.4. false: End is the far plane, which does not limit
 *   the refracted part.
 */
RefractedRay Refract(const RefractingSurface& surface, const Ray& ray, double eye, bool endsOpaque);

/** Segments along both parts, as of one ray with a direction of unit length. */
std::vector<RaySegment> FindSegments(
  const ReferenceRayIntegrator& integrator, const RefractedRay& ray);

/** Colour of both parts, one behind the other; premultiplied. */
std::array<double, 4> Compose(
  const RefractedRay& ray, const std::function<std::array<double, 4>(const Ray&)>& trace);

} // namespace meniscus::reference
