// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Rays_ClippingPlanes_h
#define meniscus_Volume_Rays_ClippingPlanes_h

#include "Volume/Rays/RayFrame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus
{

/**
 * Half space as seen by the rays of a frame. On the ray of pixel (i, j), counted from the image's
 * centre, the distance to the plane in units of the frame is
 * dot(Constant, (1, i, j)) + depth * dot(PerDepth, (1, i, j)), positive on the kept side. The part
 * of a ray within half spaces is one interval of depth.
 */
struct RayClippingPlane
{
  glm::dvec3 Constant{ 0.0 };
  glm::dvec3 PerDepth{ 0.0 };
  /** The distance of a place of the frame is dot(InFrame, (x, y, depth, 1)). */
  glm::dvec4 InFrame{ 0.0 };
};

/**
 * @param normal  towards the kept side, world coordinates, any length; 0 keeps everything.
 * @param height  dot(normal, mesh's centre - a point of the plane), world coordinates.
 */
RayClippingPlane ComputeClippingPlane(
  const RayFrame& frame, const glm::dvec3& normal, double height);

/** Narrows the part of a pixel's ray between two depths to the half space; may leave nothing. */
void ClipRay(const RayClippingPlane& plane, const glm::dvec2& pixel, double& start, double& end);

/** The same of the line place + s * step of the frame, between two values of s. */
void ClipLine(const RayClippingPlane& plane, const glm::dvec3& place, const glm::dvec3& step,
  double& start, double& end);

}

#endif
