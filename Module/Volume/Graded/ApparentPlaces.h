// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Directions in which points are seen through a medium that bends light.
 *
 * Method:
 * 1. The directions around all points are divided into a grid. A ray is followed along
 *    each of them once, and its corners are kept.
 * 2. A plane at the depth of a point is met by the rays of a triangle of the grid at the corners of
 *    a triangle. If that one has the point in it, the point is seen in about that direction. Where
 *    the map of directions to places folds over, at a caustic, several triangles have the point.
 * 3. From each of these directions, and from the straight one, Newton's method leads to the ray
 *    that meets the point, on the plane through the point across the straight direction. The
 *    determinant of its matrix is negative if the image is mirrored.
 *
 * Images that lie within one cell of the grid, in pairs that cancel, may be missed.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/HeightField.h"
#include "Volume/Graded/GradedRayWalk.h"

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/** How a point is seen. */
struct ApparentPlace
{
  /** Number of images. */
  int Images = 0;
  /** Orientation of the image that Direction leads to: 1, or -1 for a mirrored one; 0 for none. */
  int Orientation = 0;
  /** Direction of an image from the eye, unit length: of those with the orientation 1, or of all if
   * there are none, the one nearest to the straight direction, which it is without any image. */
  glm::dvec3 Direction{ 0.0 };
};

class ApparentPlaces
{
public:
  /**
   * @param walk must outlive this object.
   * @param eye in the units of the walk.
   * @param spread tangent of the largest angle between an image and the straight direction, > 0.
   * @param resolution cells of the grid along each of its axes, > 0.
   */
  ApparentPlaces(const GradedRayWalk& walk, const glm::dvec3& eye, double spread, int resolution);

  /**
   * Finds the images of points.
   * @param points in the units of the walk; those that are not finite, or at the eye, have no image
   *   and no direction.
   */
  std::vector<ApparentPlace> Find(const std::vector<glm::dvec3>& points, const RangeLoop& loop);

private:
  struct Trail;
  struct Aim;
  struct Root;

  void LayGrid(const std::vector<glm::dvec3>& points, const RangeLoop& loop);
  glm::dvec3 DirectionAt(const glm::dvec2& node) const;
  ApparentPlace FindOne(const glm::dvec3& point) const;
  std::vector<glm::dvec2> FindSeeds(const glm::dvec3& point) const;
  bool Miss(const Aim& aim, const glm::dvec2& slope, glm::dvec2& miss) const;
  bool Solve(const Aim& aim, Root& root) const;

  const GradedRayWalk& Walk;
  glm::dvec3 Eye;
  double Spread;
  int Resolution;
  /** Frame of the grid; the axis is along its middle. */
  HeightFrame Frame;
  glm::dvec2 Low{ 0.0 };
  glm::dvec2 Step{ 0.0 };
  /** Corners of the rays of the grid's nodes, in its frame. */
  std::vector<std::vector<glm::dvec3>> Trails;
};

}
