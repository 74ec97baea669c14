// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/ImplicitSurface.h"

#include "vtkImplicitFunction.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
ImplicitSurface::ImplicitSurface(vtkImplicitFunction* function, const Membrane& membrane)
  : Function(function)
{
  double along = 0.0;
  for (const Membrane::Facet& facet : membrane.GetFacets())
  {
    const auto vertex = static_cast<std::size_t>(facet[0]);
    const glm::dvec3 gradient =
      this->GetGradient(membrane.GetPositions()[vertex] + membrane.GetOrigin());
    const double length = glm::length(gradient);
    along += length > 0.0 ? glm::dot(gradient, membrane.GetNormals()[vertex]) / length : 0.0;
  }
  this->Sign = along < 0.0 ? -1.0 : 1.0;
}

//------------------------------------------------------------------------------
glm::dvec3 ImplicitSurface::GetGradient(const glm::dvec3& at) const
{
  double gradient[3] = { 0.0, 0.0, 0.0 };
  this->Function->FunctionGradient(&at.x, gradient);
  return { gradient[0], gradient[1], gradient[2] };
}

//------------------------------------------------------------------------------
bool ImplicitSurface::Meet(const glm::dvec3& origin, const glm::dvec3& direction,
  const glm::dvec3& near, PatchPoint& at) const
{
  // Newton's method converges quadratically: the remaining error is the square of the last step,
  // relative to the scene.
  constexpr double lastStep = 1e-8;
  constexpr int steps = 50;
  double distance = glm::dot(near - origin, direction);
  const double size = std::max(glm::length(origin), std::fabs(distance));
  for (int i = 0; i < steps; ++i)
  {
    at.Position = origin + distance * direction;
    const double value = this->Function->FunctionValue(&at.Position.x);
    at.Normal = this->Sign * this->GetGradient(at.Position);
    const double step = value * this->Sign / glm::dot(at.Normal, direction);
    if (!std::isfinite(step))
    {
      return false;
    }
    distance -= step;
    if (std::fabs(step) <= lastStep * size)
    {
      at.Position = origin + distance * direction;
      at.Normal = glm::normalize(this->Sign * this->GetGradient(at.Position));
      return distance > 0.0 && glm::dot(at.Normal, direction) < 0.0;
    }
  }
  return false;
}

}
