// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace meniscus
{

/** A light in the frame of the rays (RayFrame): x, y and depth relative to the mesh's centre. */
struct RayCastLight
{
  /** Position and 1, or direction towards the light, of any length, and 0. */
  glm::dvec4 Position{ 0.0 };
  /** Colours times intensity. */
  glm::dvec3 Diffuse{ 0.0 };
  glm::dvec3 Specular{ 0.0 };
  /** Axis, of length 1, and cosine of the cone's half angle; the cosine is -2 without a cone. */
  glm::dvec4 Cone{ 0.0, 0.0, 1.0, -2.0 };
  /** Coefficients of the powers 0, 1, 2 of the distance, then the exponent within the cone. */
  glm::dvec4 Falloff{ 1.0, 0.0, 0.0, 0.0 };
};

/** Material and lights of surfaces. */
struct SurfaceLighting
{
  double Ambient = 0.0;
  double Diffuse = 0.0;
  double Specular = 0.0;
  double SpecularPower = 1.0;
  std::vector<RayCastLight> Lights;
  /**
   * Global illumination: the share, in [0, 1], of its light that a medium scatters instead of
   * reflecting it at its gradient, by Henyey and Greenstein's phase function of this anisotropy;
   * and the light whose transmittance is known apart from the transmittance of the other lights.
   */
  double Scattering = 0.0;
  double Anisotropy = 0.0;
  int BrightestLight = 0;
};

bool operator==(const RayCastLight& a, const RayCastLight& b);
bool operator==(const SurfaceLighting& a, const SurfaceLighting& b);

/**
 * Strength of a light at a place, a factor of its colours: by distance and cone.
 * @param toLight gets the direction from the place to the light, of length 1.
 */
double StrengthAt(const RayCastLight& light, const glm::dvec3& place, glm::dvec3& toLight);

/** Effect of light on an emitted colour: it is multiplied by Reflected, then Highlight is added. */
struct ReflectedLight
{
  glm::dvec3 Reflected;
  glm::dvec3 Highlight;
};

/**
 * Phong's model, two-sided: the normal is turned to the viewer.
 * @param normal in the frame, of any length; 0 leaves only the ambient light.
 * @param place point of the surface, in the frame.
 * @param raySlope change of x and y per depth of the ray that sees the point.
 * @param reached shares of the ambient light, of the brightest light and of the others that reach
 *   the point; ones without shadows.
 */
ReflectedLight Light(const SurfaceLighting& lighting, const glm::dvec3& normal,
  const glm::dvec3& place, const glm::dvec2& raySlope, const glm::dvec3& reached);

}
