// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraLights.glsl (lights)
// Twin: Module/Volume/Packet/Models/PacketLights.h (lights)
#include "Volume/Optics/SurfaceLighting.h"

#include "Volume/Optics/MediumConstants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

/**
 * Clamps a cosine to [0, 1]: powers of one that rounding carried beyond 1 would overflow. The
 * cosine of a direction that does not exist, NaN, becomes 0.
 */
double Clamped(double cosine)
{
  return cosine > 0.0 ? std::min(cosine, 1.0) : 0.0;
}

}

//------------------------------------------------------------------------------
bool operator==(const RayCastLight& a, const RayCastLight& b)
{
  return a.Position == b.Position && a.Diffuse == b.Diffuse && a.Specular == b.Specular &&
    a.Cone == b.Cone && a.Falloff == b.Falloff;
}

//------------------------------------------------------------------------------
bool operator==(const SurfaceLighting& a, const SurfaceLighting& b)
{
  return a.Ambient == b.Ambient && a.Diffuse == b.Diffuse && a.Specular == b.Specular &&
    a.SpecularPower == b.SpecularPower && a.Lights == b.Lights && a.Scattering == b.Scattering &&
    a.Anisotropy == b.Anisotropy && a.BrightestLight == b.BrightestLight;
}

//------------------------------------------------------------------------------
double StrengthAt(const RayCastLight& light, const glm::dvec3& place, glm::dvec3& toLight)
{
  toLight = glm::dvec3(light.Position) - light.Position.w * place;
  const double distance = glm::length(toLight);
  toLight /= distance;
  const glm::dvec3 powers(1.0, distance, distance * distance);
  double strength =
    std::min<double>(1.0 / glm::dot(glm::dvec3(light.Falloff), powers), LargestLightStrength);
  const double inCone = -glm::dot(toLight, glm::dvec3(light.Cone));
  if (light.Cone.w >= -1.0 && light.Falloff.w != 0.0)
  {
    strength *= std::pow(Clamped(inCone), light.Falloff.w);
  }
  return inCone >= light.Cone.w ? strength : 0.0;
}

//------------------------------------------------------------------------------
ReflectedLight Light(const SurfaceLighting& lighting, const glm::dvec3& normal,
  const glm::dvec3& place, const glm::dvec2& raySlope, const glm::dvec3& reached)
{
  ReflectedLight light{ glm::dvec3(lighting.Ambient * reached.x), glm::dvec3(0.0) };
  const glm::dvec3 sizes = glm::abs(normal);
  const double largest = std::max({ sizes.x, sizes.y, sizes.z });
  if (!(largest > 0.0))
  {
    return light;
  }
  const glm::dvec3 toEye = -glm::normalize(glm::dvec3(raySlope.x, raySlope.y, 1.0));
  glm::dvec3 facing = glm::normalize(normal / largest);
  facing = glm::dot(facing, toEye) < 0.0 ? -facing : facing;
  for (std::size_t i = 0; i < lighting.Lights.size(); ++i)
  {
    const RayCastLight& source = lighting.Lights[i];
    const bool isBrightest = static_cast<int>(i) == lighting.BrightestLight;
    glm::dvec3 toLight;
    const double strength =
      (isBrightest ? reached.y : reached.z) * StrengthAt(source, place, toLight);
    const double cosine = Clamped(glm::dot(facing, toLight));
    if (cosine > 0.0)
    {
      const double glance = Clamped(glm::dot(2.0 * cosine * facing - toLight, toEye));
      light.Reflected += strength * lighting.Diffuse * cosine * source.Diffuse;
      if (glance > 0.0)
      {
        light.Highlight +=
          strength * lighting.Specular * std::pow(glance, lighting.SpecularPower) * source.Specular;
      }
    }
  }
  return light;
}

}
