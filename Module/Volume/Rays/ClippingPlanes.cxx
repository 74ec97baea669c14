// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/ClippingPlanes.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace meniscus
{
namespace
{

/** Narrows [start, end] to the part where constant + t * perUnit is not negative. */
void Clip(double constant, double perUnit, double& start, double& end)
{
  if (perUnit > 0.0)
  {
    start = std::max(start, -constant / perUnit);
  }
  else if (perUnit < 0.0)
  {
    end = std::min(end, -constant / perUnit);
  }
  else if (constant < 0.0)
  {
    end = start;
  }
}

}

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
  RayClippingPlane plane;
  plane.InFrame = glm::dvec4(inFrame / size, height / size);
  return ForRays(plane, frame);
}

//------------------------------------------------------------------------------
RayClippingPlane ForRays(const RayClippingPlane& plane, const RayFrame& frame)
{
  const glm::dvec2 across(plane.InFrame);
  const auto map = [&across](const AffinePixelMap& pixels, double constant)
  {
    return glm::dvec3(constant + glm::dot(across, pixels.Base), glm::dot(across, pixels.PerColumn),
      glm::dot(across, pixels.PerRow));
  };
  return { map(frame.Origin, plane.InFrame.w), map(frame.Slope, plane.InFrame.z), plane.InFrame };
}

//------------------------------------------------------------------------------
void ClipRay(const RayClippingPlane& plane, const glm::dvec2& pixel, double& start, double& end)
{
  const glm::dvec3 place(1.0, pixel.x, pixel.y);
  Clip(glm::dot(plane.Constant, place), glm::dot(plane.PerDepth, place), start, end);
}

//------------------------------------------------------------------------------
void ClipLine(const RayClippingPlane& plane, const glm::dvec3& place, const glm::dvec3& step,
  double& start, double& end)
{
  Clip(glm::dot(plane.InFrame, glm::dvec4(place, 1.0)),
    glm::dot(plane.InFrame, glm::dvec4(step, 0.0)), start, end);
}

}
