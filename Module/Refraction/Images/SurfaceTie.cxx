// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/SurfaceTie.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

// True if a line lies in the plane of a cell's corners, within the rounding of both, wherever it is
// close to the cell. The line is compared at two places, up to twice the cell's longest side from
// its middle. There a barycentric coordinate is at most 1 / 3 + 2 longest / height, and the plane
// is off by the error of the corners times the sum of the three.
bool LiesInPlane(const ObjectLine& line, const std::array<glm::dvec3, 3>& corners, double slack)
{
  const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = glm::length(normal);
  const double longest = GetLongestSide(corners);
  const glm::dvec3 along = glm::normalize(line.Direction);
  const glm::dvec3 nearest = line.Origin + glm::dot(middle - line.Origin, along) * along;
  const double height = area / longest;
  const double most = slack * (2.0 + 6.0 * longest / height);
  const auto isOn = [&](const glm::dvec3& place)
  { return std::fabs(glm::dot(normal, place - middle)) <= most * area; };
  return area > 0.0 && glm::length(nearest - middle) <= longest &&
    isOn(nearest - longest * along) && isOn(nearest + longest * along);
}

}

//------------------------------------------------------------------------------
double GetLongestSide(const std::array<glm::dvec3, 3>& corners)
{
  return std::max({ glm::length(corners[0] - corners[1]), glm::length(corners[1] - corners[2]),
    glm::length(corners[2] - corners[0]) });
}

//------------------------------------------------------------------------------
bool RunsAlong(const glm::dvec3& direction, const std::array<glm::dvec3, 3>& corners, double most,
  glm::dvec3& normal)
{
  const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = glm::length(across);
  normal = across / area;
  return area > 0.0 &&
    std::fabs(glm::dot(across, direction)) * GetLongestSide(corners) <=
    most * area * glm::length(direction);
}

//------------------------------------------------------------------------------
SurfaceTie FindSurfaceTie(const ObjectPrimitive& primitive,
  const std::array<glm::dvec3, 3>& corners, const glm::dvec3& behind,
  const std::array<glm::dvec3, 3>& side, double slack)
{
  // The value of a corner is its product with the primitive's normal: the error of its position,
  // and the roundings of a normal whose factors are the axes.
  const double rounding =
    2.0 * slack * glm::length(primitive.Axis[0]) * glm::length(primitive.Axis[1]);
  const double least = std::min({ behind.x, behind.y, behind.z });
  const double most = std::max({ behind.x, behind.y, behind.z });
  if (least > rounding || most < -rounding)
  {
    return SurfaceTie::None; // all of the corners are on one side of the primitive's plane
  }
  if (least >= -rounding && most <= rounding)
  {
    return SurfaceTie::Behind;
  }
  for (std::size_t k = primitive.IsLine ? PrimitiveConstraints - 1 : 1; k < PrimitiveConstraints;
       ++k)
  {
    if (LiesInPlane(primitive.Sides[k].Line, corners, slack))
    {
      // Both values are the distance of a corner from the side, times factors of constant signs.
      const bool isBehind = primitive.IsLine || glm::dot(behind, side[k - 1]) > 0.0;
      return isBehind ? SurfaceTie::Behind : SurfaceTie::InFront;
    }
  }
  return SurfaceTie::None;
}

}
