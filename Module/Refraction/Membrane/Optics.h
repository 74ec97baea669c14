// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkPlateTransmittance.glsl (reflectance)
/**
 * Refraction and reflection of one ray at one point of a surface. Directions and normals are unit
 * vectors; a normal points to the side that the ray comes from. Equation numbers refer to the
 * thesis "Refraction by geometric transforms", which Documentation/refraction-method.md summarises.
 */
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

/** Equation that a refracted ray comes from. */
enum class RayKind : unsigned char
{
  Refracted,       ///< Eq. 2.2, Snell's law, or the law of reflection.
  BackFacing,      ///< Eq. 3.1, extrapolated: the surface faces away from the ray.
  TotallyReflected ///< Eq. 3.2, extrapolated: beyond the critical angle.
};

struct RefractionRay
{
  glm::dvec3 Direction;
  RayKind Kind;
};

/** Square of the refracted ray's cosine; negative beyond the critical angle. */
inline double RefractionRadicand(double cosine, double ratio)
{
  return 1.0 - ratio * ratio * (1.0 - cosine * cosine);
}

/** Direction of the refracted ray, for ComputeRefractionRay. */
inline glm::dvec3 RefractionDirection(
  const glm::dvec3& sight, const glm::dvec3& normal, double ratio, double cosine, double radicand)
{
  const glm::dvec3 tangential = ratio * (sight - cosine * normal);
  const double root = radicand >= 0.0 ? std::sqrt(radicand) : -std::sqrt(-radicand);
  return glm::normalize(tangential - root * normal);
}

/**
 * Refracted ray of the sight ray `sight` behind a surface of normal `normal`, with `ratio` = n1 /
 * n2 (Eq. 2.2). Where there is none the ray is extrapolated, so that a facet with one bad corner
 * keeps its cell: a positive D.N counts as zero (Eq. 3.1), and beyond the critical angle the signs
 * of the radicand and of the root are reversed (Eq. 3.2). The result is normalised, which changes
 * Eq. 2.2 by rounding only. It is not finite if and only if the arguments are not.
 */
inline RefractionRay ComputeRefractionRay(
  const glm::dvec3& sight, const glm::dvec3& normal, double ratio)
{
  const double facing = glm::dot(sight, normal);
  const double cosine = std::min(facing, 0.0);
  const double radicand = RefractionRadicand(cosine, ratio);
  const RayKind kind = radicand < 0.0 ? RayKind::TotallyReflected
                                      : (facing > 0.0 ? RayKind::BackFacing : RayKind::Refracted);
  return { RefractionDirection(sight, normal, ratio, cosine, radicand), kind };
}

/**
 * Reflected ray of the sight ray `sight` at a surface of normal `normal`, D - 2 N (D.N): Snell's
 * law with n2 = -n1. A surface that faces away reflects nothing; its ray is the same expression.
 */
inline RefractionRay ComputeReflectionRay(const glm::dvec3& sight, const glm::dvec3& normal)
{
  const double facing = glm::dot(sight, normal);
  return { glm::normalize(sight - (2.0 * facing) * normal),
    facing < 0.0 ? RayKind::Refracted : RayKind::BackFacing };
}

/**
 * Fresnel reflectance of unpolarised light (Eq. 2.6 with n = n2 / n1), in [0, 1]. `cosine` is the
 * cosine of the angle of incidence in the exterior. The result is 1 beyond the critical angle and 0
 * for equal indices.
 */
inline double FresnelReflectance(double cosine, double exterior, double interior)
{
  // Without branches, for loops over lanes.
  const double c = std::min(std::max(cosine, 0.0), 1.0);
  const double n = interior / exterior;
  const double squared = n * n + c * c - 1.0;
  const double g = std::sqrt(std::max(squared, 0.0));
  const double first = (g - c) / (g + c);
  const double second = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  const double refracted = 0.5 * first * first * (1.0 + second * second);
  const double reflectance = squared <= 0.0 ? 1.0 : std::min(std::max(refracted, 0.0), 1.0);
  return exterior == interior ? 0.0 : reflectance;
}

/** Fresnel reflectances of light polarised across the plane of incidence, and within it. */
struct PolarizedReflectance
{
  double Across;
  double Within;
};

/** The two reflectances whose mean is FresnelReflectance(). */
inline PolarizedReflectance ComputePolarizedReflectance(
  double cosine, double exterior, double interior)
{
  // Without branches, for loops over lanes.
  const double c = std::min(std::max(cosine, 0.0), 1.0);
  const double n = interior / exterior;
  const double squared = n * n + c * c - 1.0;
  const double g = std::sqrt(std::max(squared, 0.0));
  const double across = (c - g) / (c + g);
  const double within = (n * n * c - g) / (n * n * c + g);
  const double most = exterior == interior ? 0.0 : 1.0;
  const bool isTotal = squared <= 0.0 || exterior == interior;
  return { isTotal ? most : across * across, isTotal ? most : within * within };
}

/**
 * Light that passes interfaces one behind another, with the reflections between them to all orders,
 * as parallel plates without absorption have them: G. G. Stokes, "On the intensity of the light
 * reflected from or transmitted through a pile of plates", Proc. R. Soc. 11 (1862). The light is
 * summed without interference, for each polarisation. Interfaces are added from the eye on.
 */
class PlateTransmittance
{
public:
  /** Adds an interface; `cosine` is the cosine of the angle of incidence in front of it. */
  void Add(double cosine, double before, double behind)
  {
    const PolarizedReflectance r = ComputePolarizedReflectance(cosine, before, behind);
    this->Across.Add(r.Across);
    this->Within.Add(r.Within);
  }

  /** Transmitted share of unpolarised light, in [0, 1]. */
  double Get() const { return 0.5 * (this->Across.Passed + this->Within.Passed); }

  /** Shares of one polarisation. */
  struct Shares
  {
    double Passed = 1.0;
    double ReflectedBack = 0.0; ///< of light that comes from behind

    void Add(double reflectance)
    {
      // Without branches, for loops over lanes. Written so that a NaN passes nothing.
      const bool mayPass = reflectance < 1.0;
      const double passed = 1.0 - reflectance;
      const double once = 1.0 - this->ReflectedBack * reflectance;
      const double back = reflectance + passed * passed * this->ReflectedBack / once;
      this->Passed = mayPass ? this->Passed * (passed / once) : 0.0;
      this->ReflectedBack = mayPass ? back : this->ReflectedBack;
    }
  };

  Shares Across{};
  Shares Within{};
};

/**
 * Schlick's approximation of the Fresnel reflectance (Eq. 2.7), which the thesis uses for drawing:
 * r + (1 - r) (1 - c)^5 with r = ((n1 - n2) / (n1 + n2))^2. It ignores the critical angle. The
 * result is 0 for equal indices, for which the formula gives (1 - c)^5.
 */
inline double SchlickReflectance(double cosine, double exterior, double interior)
{
  if (exterior == interior)
  {
    return 0.0;
  }
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double n = exterior / interior;
  const double normal = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
  return normal + (1.0 - normal) * std::pow(1.0 - c, 5.0);
}

}
