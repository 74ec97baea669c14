// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/SurfaceTie.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meniscus
{
namespace
{

// True if a line lies in the plane of a cell's corners, within the rounding of both, wherever it is
// close to the cell. The line is compared at two places, up to twice the cell's longest side from
// its middle. There a barycentric coordinate is at most 1 / 3 + 2 longest / height, and the plane
// is off by the error of the corners times the sum of the three.
bool RunsAlong(const ObjectLine& line, const std::array<glm::dvec3, 3>& corners, double slack)
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

// True if a line, at and around `place`, is closer to a surface than `error` lengths of the cell.
bool RunsAlong(const RefractionStack::Link& link, const ObjectLine& line, const glm::dvec3& place,
  const std::array<glm::dvec3, 3>& corners, double error)
{
  const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = glm::length(across);
  const double most = error * GetLongestSide(corners);
  SurfaceCrossing crossing;
  return std::fabs(glm::dot(across, line.Direction)) <=
    error * area * glm::length(line.Direction) &&
    area > 0.0 && link.Surface->FindCrossing(place, across / area, 0, -most, most, crossing);
}

}

//------------------------------------------------------------------------------
double GetLongestSide(const std::array<glm::dvec3, 3>& corners)
{
  return std::max({ glm::length(corners[0] - corners[1]), glm::length(corners[1] - corners[2]),
    glm::length(corners[2] - corners[0]) });
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
    if (RunsAlong(primitive.Sides[k].Line, corners, slack))
    {
      // Both values are the distance of a corner from the side, times factors of constant signs.
      const bool isBehind = primitive.IsLine || glm::dot(behind, side[k - 1]) > 0.0;
      return isBehind ? SurfaceTie::Behind : SurfaceTie::InFront;
    }
  }
  return SurfaceTie::None;
}

//------------------------------------------------------------------------------
std::array<glm::dvec3, 3> GetSurfaceCorners(const LegCell& cell, bool isEnd)
{
  return isEnd ? cell.Ends
               : std::array<glm::dvec3, 3>{ cell.Nodes[0].From.At.Position,
                   cell.Nodes[1].From.At.Position, cell.Nodes[2].From.At.Position };
}

//------------------------------------------------------------------------------
bool MoveToSurface(const RefractionStack::Link& link, const ObjectLine& side,
  const std::array<glm::dvec3, 3>& corners, double error, double& l)
{
  const ObjectLine line{ side.Origin - link.Shift, side.Direction };
  const glm::dvec3 guess = line.GetPoint(l);
  if (RunsAlong(link, line, guess, corners, error))
  {
    return true;
  }
  const double length = glm::length(line.Direction);
  SurfaceCrossing nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const double sign : { 1.0, -1.0 })
  {
    SurfaceCrossing crossing;
    if (link.Surface->FindCrossing(guess, sign / length * line.Direction, 0,
          -link.Surface->GetSlack(glm::length(guess)), std::numeric_limits<double>::max(),
          crossing) &&
      crossing.Distance < least)
    {
      least = crossing.Distance;
      nearest = crossing;
    }
  }
  if (nearest.Facet == CurvedPatches::NoFacet || least > GetLongestSide(corners))
  {
    return false;
  }
  const CurvedPatch patch = link.Surface->GetPatches().GetPatch(nearest.Facet);
  glm::dvec2 at = nearest.B;
  l = glm::dot(patch.Evaluate(at).Position - line.Origin, line.Direction) / (length * length);
  MeetPatchAgain(patch, line, at, l);
  return true;
}

}
