// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/RayFrame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus
{

/**
 * Half space in the frame of the rays. On the ray of pixel (i, j), counted from the image's centre,
 * the signed distance to the plane in units of the frame is dot(Constant, (1, i, j)) + depth *
 * dot(PerDepth, (1, i, j)), positive on the kept side. The part of a ray within several half spaces
 * is one interval of depth.
 */
struct RayClippingPlane
{
  glm::dvec3 Constant{ 0.0 };
  glm::dvec3 PerDepth{ 0.0 };
  /** The distance of a point of the frame is dot(InFrame, (x, y, depth, 1)). */
  glm::dvec4 InFrame{ 0.0 };
};

inline bool operator==(const RayClippingPlane& a, const RayClippingPlane& b)
{
  return a.Constant == b.Constant && a.PerDepth == b.PerDepth && a.InFrame == b.InFrame;
}

/**
 * @param normal points to the kept side; world coordinates, any length. 0 keeps everything.
 * @param height dot(normal, mesh's centre - a point of the plane), world coordinates.
 */
RayClippingPlane ComputeClippingPlane(
  const RayFrame& frame, const glm::dvec3& normal, double height);

/** The same plane for other rays of the same frame: Refined() or Shifted(). */
RayClippingPlane ForRays(const RayClippingPlane& plane, const RayFrame& frame);

/** Narrows the depth range of a pixel's ray to the half space; the result may be empty. */
void ClipRay(const RayClippingPlane& plane, const glm::dvec2& pixel, double& start, double& end);

/** As ClipRay, for the line place + s * step of the frame and a range of s. */
void ClipLine(const RayClippingPlane& plane, const glm::dvec3& place, const glm::dvec3& step,
  double& start, double& end);

}
