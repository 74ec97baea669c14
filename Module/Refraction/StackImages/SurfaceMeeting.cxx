// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/SurfaceMeeting.h"

#include <glm/geometric.hpp>

#include <limits>

namespace meniscus
{
namespace
{

// True if a line, at and around `place`, is closer to a surface than `error` lengths of the cell.
bool StaysAlong(const RefractionStack::Link& link, const ObjectLine& line, const glm::dvec3& place,
  const std::array<glm::dvec3, 3>& corners, double error)
{
  const double most = error * GetLongestSide(corners);
  glm::dvec3 normal;
  SurfaceCrossing crossing;
  return RunsAlong(line.Direction, corners, most, normal) &&
    link.Surface->FindCrossing(place, normal, 0, -most, most, crossing);
}

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
  if (StaysAlong(link, line, guess, corners, error))
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
