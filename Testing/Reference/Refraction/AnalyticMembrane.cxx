// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticMembrane.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace meniscus::reference
{
namespace
{

const double Pi = std::acos(-1.0);

// Bisects a bracket until its middle equals one of its ends.
template <typename Function>
double Bisect(const Function& f, double low, double high)
{
  const bool rising = f(low) < 0.0;
  for (;;)
  {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high)
    {
      return middle;
    }
    ((f(middle) < 0.0) == rising ? low : high) = middle;
  }
}

}

//------------------------------------------------------------------------------
glm::dvec3 AnalyticMembrane::GetNormal(const glm::dvec3& onSurface) const
{
  return this->SphereRadius > 0.0
    ? glm::normalize(glm::dvec3(0.0, this->SphereRadius, 0.0) - onSurface)
    : glm::dvec3(0.0, 1.0, 0.0);
}

//------------------------------------------------------------------------------
std::optional<glm::dvec3> AnalyticMembrane::Intersect(
  const glm::dvec3& eye, const glm::dvec3& direction) const
{
  if (this->SphereRadius <= 0.0)
  {
    if (!(direction.y < 0.0) || !(eye.y > 0.0))
    {
      return {};
    }
    return eye - direction * (eye.y / direction.y);
  }
  const glm::dvec3 toCentre = glm::dvec3(0.0, this->SphereRadius, 0.0) - eye;
  const double along = glm::dot(toCentre, direction);
  const double squared =
    along * along - glm::dot(toCentre, toCentre) + this->SphereRadius * this->SphereRadius;
  if (squared < 0.0)
  {
    return {};
  }
  const double distance = along + std::sqrt(squared);
  const glm::dvec3 hit = eye + direction * distance;
  if (distance <= 0.0 || hit.y > this->SphereRadius)
  {
    return {};
  }
  return hit;
}

//------------------------------------------------------------------------------
std::optional<glm::dvec3> AnalyticMembrane::Refract(
  const glm::dvec3& direction, const glm::dvec3& onSurface) const
{
  const glm::dvec3 normal = this->GetNormal(onSurface);
  const glm::dvec3 tangent = direction - normal * glm::dot(direction, normal);
  const double sineIn = glm::length(tangent);
  const double sineOut = sineIn * this->Exterior / this->Interior;
  if (sineOut > 1.0 || glm::dot(direction, normal) > 0.0)
  {
    return {};
  }
  const double cosineOut = std::sqrt((1.0 - sineOut) * (1.0 + sineOut));
  return (sineIn > 0.0 ? tangent * (sineOut / sineIn) : glm::dvec3(0.0)) - normal * cosineOut;
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> AnalyticMembrane::FindSightPoints(
  const glm::dvec3& eye, const glm::dvec3& point) const
{
  return this->SphereRadius > 0.0 ? this->FindOnSphere(eye, point) : this->FindOnPlane(eye, point);
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> AnalyticMembrane::FindOnPlane(
  const glm::dvec3& eye, const glm::dvec3& point) const
{
  if (!(eye.y > 0.0) || !(point.y < 0.0))
  {
    return {};
  }
  const glm::dvec3 across(point.x - eye.x, 0.0, point.z - eye.z);
  const double distance = glm::length(across);
  const glm::dvec3 foot(eye.x, 0.0, eye.z);
  if (distance == 0.0)
  {
    return { foot };
  }
  // Derivative of the optical path (Fermat): increases with x, negative at 0, positive at the far
  // end.
  const auto residual = [this, &eye, &point, distance](double x)
  {
    return this->Exterior * x / std::hypot(x, eye.y) -
      this->Interior * (distance - x) / std::hypot(distance - x, point.y);
  };
  return { foot + across * (Bisect(residual, 0.0, distance) / distance) };
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> AnalyticMembrane::FindOnSphere(
  const glm::dvec3& eye, const glm::dvec3& point) const
{
  // Eye, point and every sight point lie in one plane through the centre.
  const glm::dvec3 centre(0.0, this->SphereRadius, 0.0);
  const glm::dvec3 first = glm::normalize(eye - centre);
  glm::dvec3 across = (point - centre) - first * glm::dot(point - centre, first);
  if (glm::length(across) <= 1e-14 * glm::length(point - centre))
  {
    across =
      glm::cross(first, std::fabs(first.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
  }
  const glm::dvec3 second = glm::normalize(across);
  const auto at = [this, &centre, &first, &second](double angle)
  { return centre + this->SphereRadius * (std::cos(angle) * first + std::sin(angle) * second); };
  const auto residual = [this, &eye, &point, &first, &second, &at](double angle)
  {
    const glm::dvec3 tangent = -std::sin(angle) * first + std::cos(angle) * second;
    const glm::dvec3 s = at(angle);
    return this->Exterior * glm::dot(glm::normalize(s - eye), tangent) -
      this->Interior * glm::dot(glm::normalize(point - s), tangent);
  };

  std::vector<glm::dvec3> found;
  constexpr int steps = 20000;
  double low = -Pi;
  for (int i = 1; i <= steps; ++i)
  {
    const double high = -Pi + 2.0 * Pi * i / steps;
    if ((residual(low) < 0.0) != (residual(high) < 0.0))
    {
      const glm::dvec3 s = at(Bisect(residual, low, high));
      const glm::dvec3 normal = this->GetNormal(s);
      if (s.y <= this->SphereRadius && glm::dot(s - eye, normal) < 0.0 &&
        glm::dot(point - s, normal) < 0.0)
      {
        found.push_back(s);
      }
    }
    low = high;
  }
  return found;
}

//------------------------------------------------------------------------------
std::optional<glm::dvec3> AnalyticMembrane::FindTruePoint(
  const glm::dvec3& eye, const glm::dvec3& virtualVertex) const
{
  const glm::dvec3 direction = glm::normalize(virtualVertex - eye);
  const auto sightPoint = this->Intersect(eye, direction);
  if (!sightPoint)
  {
    return {};
  }
  const auto refracted = this->Refract(direction, *sightPoint);
  if (!refracted)
  {
    return {};
  }
  const double apparent = glm::length(virtualVertex - *sightPoint);
  return *sightPoint + *refracted * (apparent * this->Interior / this->Exterior);
}

}
