// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Rays/RayFrame.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkCamera;

namespace meniscus
{

/** Rays of an image of integrals. */
struct IntegralView
{
  RayFrame Rays;
  /** Centre of the mesh in world coordinates. */
  glm::dvec3 Center{ 0.0 };
  /** Depth in the frame at which rays begin. */
  double BeginDepth = 0.0;
  /** Depth from which distances along the rays count. */
  double MeasuredFrom = 0.0;
};

/** Rectangle whose normal is the direction of parallel rays: a corner and two edges. */
struct ParallelRectangle
{
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 Axis1{ 1.0, 0.0, 0.0 };
  glm::dvec3 Axis2{ 0.0, 1.0, 0.0 };

  /** Direction of the rays: an image with its first axis to the right is seen from its front. */
  glm::dvec3 GetDirection() const;
};

/** Reason why a rectangle cannot be used; empty if it can. */
std::string DescribeFault(const ParallelRectangle& rectangle);

/**
 * Rectangle perpendicular to a direction around a box, through the box's nearest corner.
 * @param middle centre of the box in world coordinates.
 * @param half half edges of the box.
 * @param up direction that is drawn upwards.
 * @param size pixels of the image; the rectangle is widened to square pixels.
 * @param rectangle replaced by the result.
 * @return an error, or an empty text.
 */
std::string FitRectangle(const glm::dvec3& middle, const glm::dvec3& half,
  const glm::dvec3& direction, const glm::dvec3& up, const int size[2],
  ParallelRectangle& rectangle);

/**
 * Rays of a camera, from its position on, or from the plane through it. Clipping planes of the
 * camera do not count.
 * @return an error, or an empty text.
 */
std::string ComputeCameraView(
  vtkCamera* camera, const int size[2], const TetrahedralMesh& mesh, IntegralView& view);

/**
 * Rays through a rectangle, from before the mesh and before all `others`.
 * @param others points in world coordinates, the corners of boxes around refracting surfaces.
 * @pre DescribeFault() finds nothing.
 * @return an error, or an empty text.
 */
std::string ComputeParallelView(const ParallelRectangle& rectangle, const int size[2],
  const TetrahedralMesh& mesh, const std::vector<glm::dvec3>& others, IntegralView& view);

}
