// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact refraction at the plane y = 0 and at the lower half of a sphere that touches it from above.
 * Written independently of the kernel: Snell's law is used as n1 sin a = n2 sin b, not as Eq. 2.2.
 */
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace meniscus::reference
{

struct AnalyticMembrane
{
  double SphereRadius = 0.0; ///< 0: the plane
  double Exterior = 1.0;     ///< index above
  double Interior = 1.0;     ///< index below

  glm::dvec3 GetNormal(const glm::dvec3& onSurface) const;

  /**
   * Point where the ray from the eye leaves the exterior; nothing if it misses or comes from
   * behind.
   */
  std::optional<glm::dvec3> Intersect(const glm::dvec3& eye, const glm::dvec3& direction) const;

  /** Direction of the refracted ray; nothing under total internal reflection. */
  std::optional<glm::dvec3> Refract(const glm::dvec3& direction, const glm::dvec3& onSurface) const;

  /**
   * All sight points of `point`, by bracketed roots in the plane that contains eye, point and axis.
   * Roots closer than 1/20000 of the scanned arc may be missed.
   */
  std::vector<glm::dvec3> FindSightPoints(const glm::dvec3& eye, const glm::dvec3& point) const;

  /** Point behind the surface that is drawn at `virtualVertex` (exact inverse of Eq. 2.4). */
  std::optional<glm::dvec3> FindTruePoint(
    const glm::dvec3& eye, const glm::dvec3& virtualVertex) const;

private:
  std::vector<glm::dvec3> FindOnPlane(const glm::dvec3& eye, const glm::dvec3& point) const;
  std::vector<glm::dvec3> FindOnSphere(const glm::dvec3& eye, const glm::dvec3& point) const;
};

}
