// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/TruePositions.h"

#include "Refraction/Curved/CurveCrossings.h"
#include "Refraction/Curved/PatchCrossings.h"
#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Patches to go through from the facet that a ray passes through, and facets on the way there. For
// longer ways the tree is faster.
constexpr int LongestChase = 4;
constexpr int LongestWalk = 16;

// As in PatchCrossings: the remaining error is of the order of the square of the last step.
constexpr double LastStep = 1e-7;

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
TruePositions::TruePositions(const CurvedMembraneSolver& geometry, const SteepDirections& steep)
  : Geometry(geometry)
  , Steep(steep)
  , Search(geometry)
  , Eye(geometry.GetMedia().Eye + geometry.GetMembrane().GetOrigin())
{
}

//------------------------------------------------------------------------------
// Newton's method from the facet that the ray passes through, across patches.
bool TruePositions::Follow(const glm::dvec3& direction, Memory& memory, PatchPoint& at) const
{
  const glm::dvec3& eye = this->Geometry.GetMedia().Eye;
  const CurvedPatches& patches = this->Geometry.GetPatches();
  const double distance = glm::dot(memory.SightPoint - eye, direction);
  if (!(distance > 0.0))
  {
    return false;
  }
  // The direction is scaled to the distance of the surface, so that the line's parameter there is
  // about 1.
  const ObjectLine ray{ eye, distance * direction };
  glm::dvec3 target = eye + ray.Direction;
  for (int i = 0; i < LongestChase; ++i)
  {
    const std::int32_t facet = patches.Walk(memory.Facet, target, direction, LongestWalk);
    if (facet != memory.Facet)
    {
      memory.Facet = facet;
      memory.Patch = patches.GetPatch(facet);
      memory.Offset = glm::dvec2(0.0);
    }
    else if (i > 0)
    {
      return false; // beyond the border
    }
    const glm::dvec2 flat = MeetFacet(memory.Patch, ray);
    glm::dvec2 b = flat + memory.Offset;
    double l = 1.0;
    glm::dvec3 normal;
    if (!MeetPatch(memory.Patch, ray, LastStep, b, l, normal))
    {
      return false;
    }
    if (FindOutside(b).Least >= -PatchCrossings::Border)
    {
      memory.Offset = b - flat;
      memory.SightPoint = eye + l * ray.Direction;
      at = { memory.SightPoint + this->Geometry.GetMembrane().GetOrigin(), glm::normalize(normal) };
      return l > 0.0 && glm::dot(normal, direction) < 0.0;
    }
    target = memory.Patch.GetFlatPoint(b);
  }
  return false;
}

//------------------------------------------------------------------------------
// Intersection with the membrane. A ray that is known to cross it once at most needs no search.
bool TruePositions::Meet(const glm::dvec3& direction, Memory& memory, PatchPoint& at) const
{
  const bool isSteep = this->Steep.Contains(direction);
  if (isSteep && memory.Facet != CurvedPatches::NoFacet && this->Follow(direction, memory, at))
  {
    return true;
  }
  memory.Facet = CurvedPatches::NoFacet;
  std::int32_t facet = CurvedPatches::NoFacet;
  if (!this->Search.Find(direction, this->Eye, at, facet))
  {
    return false;
  }
  if (isSteep)
  {
    memory = { facet, this->Geometry.GetPatches().GetPatch(facet),
      at.Position - this->Geometry.GetMembrane().GetOrigin(), glm::dvec2(0.0) };
  }
  return true;
}

//------------------------------------------------------------------------------
TruePosition TruePositions::Find(const glm::dvec3& seen, Memory& memory) const
{
  const glm::dvec3 none(std::numeric_limits<double>::quiet_NaN());
  const glm::dvec3 sight = seen - this->Eye;
  const double distance = glm::length(sight);
  if (!std::isfinite(distance) || distance == 0.0)
  {
    return { seen, none, SeenState::NotFinite };
  }
  const glm::dvec3 direction = sight / distance;
  PatchPoint at;
  if (!this->Meet(direction, memory, at))
  {
    return { seen, none, SeenState::Unrefracted };
  }
  const double apparent = glm::dot(seen - at.Position, direction);
  if (apparent <= 0.0)
  {
    return { seen, none, SeenState::Unrefracted };
  }
  const Media& media = this->Geometry.GetMedia();
  const RefractionRay ray =
    ComputeRefractionRay(direction, at.Normal, media.Exterior / media.Interior);
  if (ray.Kind != RayKind::Refracted)
  {
    return { seen, at.Position, SeenState::TotallyReflected };
  }
  const double depth = apparent * media.Interior / media.Exterior;
  return { at.Position + depth * ray.Direction, at.Position, SeenState::Refracted };
}

}
