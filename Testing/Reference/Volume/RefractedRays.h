// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays that bend at a refracting surface, in double, and the mesh along them: what the integrators
 * need of a volume that is seen through a membrane. Surfaces are formulas, and Snell's law is
 * n1 sin a = n2 sin b: nothing of the kernel's patches or of its optics.
 */
#ifndef meniscus_RefractedRays_h
#define meniscus_RefractedRays_h

#include "ReferenceRayIntegrator.h"

#include <functional>
#include <vector>

namespace meniscus
{
namespace reference
{

struct RefractingSurface
{
  /** Whether a place of the endless surface belongs to it. */
  std::function<bool(const Vector3&)> Has = [](const Vector3&) { return true; };
  /** All parameters at which a ray with a direction of unit length meets the endless surface. */
  std::function<std::vector<double>(const Ray&)> Meet;
  /** Unit normal at a place of it, to the exterior. */
  std::function<Vector3(const Vector3&)> Normal;
  double Exterior = 1.0;
  double Interior = 1.333;
};

/** The plane through a point. */
RefractingSurface makePlane(const Vector3& origin, const Vector3& normal);
/** The sphere, its normals outwards. */
RefractingSurface makeSphere(const Vector3& center, double radius);
/**
 * The height field y = level + amplitude sin(k x) sin(k z), its normals upwards. Pairs of places
 * that are nearer to each other than 1 / 64 of a wave may be missed.
 */
RefractingSurface makeWaves(double level, double amplitude, double k);

/** A ray before and behind the surface; directions have unit length. */
struct RefractedRay
{
  Ray Straight;
  /** Begin >= End if the ray does not meet the surface, or is totally reflected. */
  Ray Bent;
};

/**
 * @param eye  the ray's parameter where looking begins; its Begin is the near plane.
 * @param endsOpaque  whether something opaque is drawn at the ray's End: behind the surface at what
 * Eq. 2.4 makes of that. Else it is the far plane, which does not end the bent part.
 */
RefractedRay refract(const RefractingSurface& surface, const Ray& ray, double eye, bool endsOpaque);

/** Segments along both parts, as of one ray with a direction of unit length. */
std::vector<RaySegment> findSegments(
  const ReferenceRayIntegrator& integrator, const RefractedRay& ray);

/** What both parts show, one behind the other; premultiplied. */
std::array<double, 4> compose(
  const RefractedRay& ray, const std::function<std::array<double, 4>(const Ray&)>& trace);

} // namespace reference
} // namespace meniscus

#endif
