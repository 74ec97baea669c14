// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays through planes, spheres and spheroids in closed form, and their meshes: the truth for stacks
 * of interfaces, independent of the kernel's patches and equations.
 */
#pragma once

#include "MembraneMeshes.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace meniscus::reference
{

/** A plane, a sphere or a spheroid between two media, as a ray passes it. */
struct ExactSurface
{
  double Before;
  double Behind;
  glm::dvec3 Centre;        ///< of the sphere, or a point of the plane
  double Radius = 0.0;      ///< of the sphere; 0 for a plane
  glm::dvec3 Normal{ 0.0 }; ///< of the plane
  bool IsFarSide = false;   ///< the ray meets the sphere from inside
  double Stretch = 1.0;     ///< spheroid x x + z z + Stretch y y = Radius^2 about the y axis
};

/** Points of a ray on all surfaces, and its directions: before the first one and behind each. */
struct ExactPath
{
  std::vector<glm::dvec3> Points;
  std::vector<glm::dvec3> Directions;
};

/** The path of the ray from the eye; nothing if it misses a surface or is totally reflected. */
std::optional<ExactPath> TraceExactly(
  const std::vector<ExactSurface>& surfaces, const glm::dvec3& eye, const glm::dvec3& direction);

/** A point at `length` on the path's last ray, and its virtual point by Eq. 2.4 for every leg. */
struct ExactImage
{
  glm::dvec3 Point;
  glm::dvec3 Virtual;
};
ExactImage MakeImage(
  const std::vector<ExactSurface>& surfaces, const ExactPath& path, double length);

/** Reflectances of both polarisations for an angle of incidence with this sine in a vacuum. */
glm::dvec2 MakeReflectances(double sine, double before, double behind);

/** Reflectance of unpolarised light, the mean of both; 1 beyond the critical angle. */
double MakeReflectance(double cosine, double before, double behind);

/**
 * Transmittance of a plate for unpolarised light: the sum of the geometric series of the light that
 * is reflected between its sides, for each polarisation.
 */
double MakePlateTransmittance(double sine, double before, double plate, double behind);

/** A whole sphere, an icosahedron divided `levels` times: 20 * 4^levels facets. */
MembraneMesh MakeSphere(const glm::dvec3& centre, double radius, int levels, bool outwards);

/**
 * A square cap of a sphere around `centre` about the axis `along` (a unit vector along y or -y),
 * `cells` x `cells` x 2 facets, normals to the side of `front`. `side` is that of the square under
 * the cap.
 */
MembraneMesh MakeCap(const glm::dvec3& centre, double radius, const glm::dvec3& along,
  const glm::dvec3& front, double side, int cells);

/** A square at height `y` with normals along +y, or -y if `down`. */
MembraneMesh MakePlane(double y, double side, int cells, bool down = false);

}
