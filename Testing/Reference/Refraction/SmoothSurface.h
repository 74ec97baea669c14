// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A height field y = f(x, z) over a square about the origin: a sum of plane waves, hills and a cap
 * of a sphere, with first and second derivatives, at points and over intervals.
 */
#pragma once

#include "Interval.h"
#include "MembraneMeshes.h"

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace meniscus::reference
{

/** A height and its derivatives. */
template <typename T>
struct HeightJet
{
  T F = T(0.0);
  T X = T(0.0);
  T Z = T(0.0);
  T Xx = T(0.0);
  T Xz = T(0.0);
  T Zz = T(0.0);
};

struct SmoothSurface
{
  /** amplitude sin(kx x + kz z + phase) */
  struct Wave
  {
    double Amplitude;
    double Kx;
    double Kz;
    double Phase;
  };
  /** amplitude exp(-k k ((x - centreX)^2 + (z - centreZ)^2)) */
  struct Hill
  {
    double Amplitude;
    double K;
    double CentreX;
    double CentreZ;
  };

  double Side = 200.0;
  std::vector<Wave> Waves;
  std::vector<Hill> Hills;
  /**
   * Radius of a sphere through the origin, above 0.75 `side`: positive with its centre above
   * (concave to the eye), negative below, 0: none.
   */
  double SphereRadius = 0.0;

  HeightJet<double> At(double x, double z) const;
  HeightJet<Interval> Over(const Interval& x, const Interval& z) const;

  glm::dvec3 GetPoint(double x, double z) const { return { x, this->At(x, z).F, z }; }
  glm::dvec3 GetNormal(double x, double z) const;

  /** Intersection of the ray from the eye with the surface, by Newton's method from `distance`. */
  glm::dvec3 Intersect(const glm::dvec3& eye, const glm::dvec3& direction, double distance) const;

  /**
   * Unit direction of the refracted ray at `onSurface`, by n1 sin a = n2 sin b with `ratio` = n1 /
   * n2; nothing for rays from behind and under total internal reflection.
   */
  std::optional<glm::dvec3> Refract(
    const glm::dvec3& eye, const glm::dvec3& onSurface, double ratio) const;

  /** `cells` x `cells` x 2 facets with exact normals. */
  MembraneMesh MakeMesh(int cells) const;
};

}
