// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Refraction or reflection at an analytic height field y = f(x, z) over a square, the eye above it.
 * Sight points are the stationary points of the optical path n1 |S - E| + n2 |P - S| (Fermat),
 * found by a dense search in double precision, independently of the kernel's patches, trees and
 * equations.
 */
#pragma once

#include "MembraneMeshes.h"

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace meniscus::reference
{

struct HeightField
{
  enum class Shape
  {
    Waves, ///< amplitude sin(k x) sin(k z)
    Dome   ///< amplitude exp(-(k k (x x + z z))), convex to the eye for a positive amplitude
  };
  Shape Shape = Shape::Waves;
  double Side = 200.0;
  double Amplitude = 0.0;
  double K = 0.0;
  double Exterior = 1.0;
  double Interior = 1.333;
  bool Mirrors = false; ///< reflection, of points above the field; the indices must be 1

  double GetHeight(double x, double z) const;
  /** df / dx and df / dz. */
  void GetSlopes(double x, double z, double& dx, double& dz) const;
  glm::dvec3 GetNormal(double x, double z) const;

  /** `cells` x `cells` x 2 facets with exact normals. */
  MembraneMesh MakeMesh(int cells) const;

  /** All sight points of `point`. Pairs closer than about 1 / `grid` of the side may be missed. */
  std::vector<glm::dvec3> FindSightPoints(
    const glm::dvec3& eye, const glm::dvec3& point, int grid = 200) const;

  /**
   * Intersection of the sight ray of `direction` with the surface, by an iteration from `distance`.
   */
  glm::dvec3 Intersect(const glm::dvec3& eye, const glm::dvec3& direction, double distance) const;

  /**
   * Point at a distance of `length` behind `onSurface` on the refracted ray, by n1 sin a = n2 sin
   * b; nothing under total internal reflection. For a mirror, on the reflected ray.
   */
  std::optional<glm::dvec3> Refract(
    const glm::dvec3& eye, const glm::dvec3& onSurface, double length) const;
};

}
