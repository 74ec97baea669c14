// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/CrossingChain.h"

#include "Refraction/Surface/CurveCrossings.h"
#include "Refraction/Surface/PatchCrossings.h"

#include <glm/geometric.hpp>

namespace meniscus
{
namespace
{

// Patches to go through from the facet that a ray passes through, and facets on the way there. For
// longer ways the tree is faster.
constexpr int LongestChase = 4;
constexpr int LongestWalk = 16;

/** Place where a line meets a facet's plane, by Cramer's rule. */
glm::dvec2 MeetFacet(const CurvedPatch& patch, const ObjectLine& line)
{
  const glm::dvec3 u = patch.Corner[1] - patch.Corner[0];
  const glm::dvec3 v = patch.Corner[2] - patch.Corner[0];
  const glm::dvec3 rest = line.Origin - patch.Corner[0];
  const glm::dvec3 across = glm::cross(v, line.Direction);
  const double inverse = 1.0 / glm::dot(u, across);
  return { inverse * glm::dot(rest, across),
    inverse * glm::dot(u, glm::cross(rest, line.Direction)) };
}

}

//------------------------------------------------------------------------------
void CrossingChain::Begin(
  const CurvedPatches& patches, std::int32_t facet, const glm::dvec3& position)
{
  this->Facet = facet;
  this->Patch = patches.GetPatch(facet);
  this->Position = position;
  this->Offset = glm::dvec2(0.0);
}

//------------------------------------------------------------------------------
bool CrossingChain::Follow(const CurvedPatches& patches, const glm::dvec3& origin,
  const glm::dvec3& direction, PatchPoint& at)
{
  const double distance = glm::dot(this->Position - origin, direction);
  if (this->Facet == CurvedPatches::NoFacet || !(distance > 0.0))
  {
    return false;
  }
  // The direction is scaled to the distance of the surface, so that the line's parameter there is
  // about 1.
  const ObjectLine ray{ origin, distance * direction };
  glm::dvec3 target = origin + ray.Direction;
  for (int i = 0; i < LongestChase; ++i)
  {
    const std::int32_t facet = patches.Walk(this->Facet, target, direction, LongestWalk);
    if (facet != this->Facet)
    {
      this->Facet = facet;
      this->Patch = patches.GetPatch(facet);
      this->Offset = glm::dvec2(0.0);
    }
    else if (i > 0)
    {
      return false; // beyond the border
    }
    const glm::dvec2 flat = MeetFacet(this->Patch, ray);
    glm::dvec2 b = flat + this->Offset;
    double l = 1.0;
    glm::dvec3 normal;
    if (!MeetPatch(this->Patch, ray, b, l, normal))
    {
      return false;
    }
    if (FindOutside(b).Least >= -PatchCrossings::Border)
    {
      this->Offset = b - flat;
      this->Position = origin + l * ray.Direction;
      at = { this->Position, glm::normalize(normal) };
      return l > 0.0;
    }
    target = this->Patch.GetFlatPoint(b);
  }
  return false;
}

}
