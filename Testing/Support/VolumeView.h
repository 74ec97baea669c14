// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceCellTree.h"

#include <glm/vec3.hpp>

class vtkRenderer;

namespace meniscus::test
{

/**
 * One camera in the forms that the kernel, VTK and the reference use, from the same parameters in
 * double precision. Images are square.
 */
struct VolumeView
{
  glm::dvec3 Eye{ 0.0, 0.0, 1.0 };
  glm::dvec3 Focus{ 0.0 };
  glm::dvec3 Up{ 0.0, 1.0, 0.0 };
  bool Parallel = false;
  /**
   * Half the height of the visible region, at unit depth (perspective) or at any depth (parallel).
   */
  double HalfHeight = 0.27;
  /** Depths of the clipping planes. */
  double Near = 0.1;
  double Far = 10.0;

  /**
   * Looks at the middle of bounds from a direction. The whole bounding sphere is visible at zoom 1.
   */
  static VolumeView Towards(
    const double bounds[6], const glm::dvec3& direction, bool parallel, double zoom = 1.0);

  /** Ray of a pixel of size x size pixels; its parameter is the depth. */
  reference::Ray GetRay(int x, int y, int size) const;

  void ApplyTo(vtkRenderer* renderer) const;

private:
  struct Axes
  {
    glm::dvec3 Right;
    glm::dvec3 Up;
    glm::dvec3 Forward;
  };
  Axes GetAxes() const;
};

} // namespace meniscus::test
