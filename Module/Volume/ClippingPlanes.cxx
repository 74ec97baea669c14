// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/ClippingPlanes.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace meniscus
{

//------------------------------------------------------------------------------
RayClippingPlane ComputeClippingPlane(
  const RayFrame& frame, const glm::dvec3& normal, double height)
{
  const glm::dvec3 inFrame = glm::transpose(frame.ViewToWorld) * normal;
  const double size = glm::length(inFrame);
  if (!(size > 0.0))
  {
    return RayClippingPlane();
  }
  const glm::dvec3 unit = inFrame / size;
  const glm::dvec2 across(unit);
  const auto map = [&across](const AffinePixelMap& pixels, double constant)
  {
    return glm::dvec3(constant + glm::dot(across, pixels.Base), glm::dot(across, pixels.PerColumn),
      glm::dot(across, pixels.PerRow));
  };
  return { map(frame.Origin, height / size), map(frame.Slope, unit.z) };
}

}
