// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackSightRay.h"

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Side of a link's interface from which rays arrive, or where they go on: see SightLeg. */
std::size_t GetSide(const RefractionStack::Link& link, bool behind)
{
  return 2 * link.Index + (link.Passage.FromFront == behind ? 1 : 0);
}

}

//------------------------------------------------------------------------------
StackPatches::StackPatches(
  const std::vector<RefractionStack::Link>& links, const glm::dvec3& origin, StackChain* chain)
  : Links(links)
  , Origin(origin)
  , Chain(chain)
{
  if (chain && !links.empty())
  {
    chain->resize(std::max(chain->size(), links.back().Index + 1));
  }
}

//------------------------------------------------------------------------------
// The crossing nearest to the distance `near`, relative to the surface's origin.
bool StackPatches::Search(const RefractionStack::Link& link, const glm::dvec3& origin,
  const glm::dvec3& direction, double near, CrossingChain* chain, PatchPoint& at) const
{
  SurfaceCrossing crossing;
  if (!link.FindCrossing(origin, direction, 0.0, crossing))
  {
    return false;
  }
  SurfaceCrossing next = crossing;
  // Crossings within rounding of the last one are the same, at a common edge of two patches.
  const double slack = link.Surface->GetSlack(glm::length(origin));
  while (
    next.Distance < near && link.FindCrossing(origin, direction, next.Distance + 2.0 * slack, next))
  {
    crossing =
      std::fabs(next.Distance - near) < std::fabs(crossing.Distance - near) ? next : crossing;
  }
  const CurvedPatch patch = link.Surface->GetPatch(crossing.Facet, false);
  // The direction is scaled, so that the parameter is about 1.
  const double scale = std::max(patch.GetSize(), crossing.Distance);
  double l = crossing.Distance / scale;
  glm::dvec2 b = crossing.B;
  glm::dvec3 normal;
  if (!MeetPatch(patch, { origin, scale * direction }, b, l, normal))
  {
    return false;
  }
  const double length = glm::length(normal);
  at = { origin + l * scale * direction, normal / length };
  if (chain)
  {
    chain->Begin(link.Surface->GetPatches(), crossing.Facet, at.Position);
  }
  // Written so that a NaN fails.
  return length > CurvedPatch::ShortestNormal;
}

//------------------------------------------------------------------------------
bool StackPatches::Meet(std::size_t number, const glm::dvec3& origin, const glm::dvec3& direction,
  const glm::dvec3& near, PatchPoint& at) const
{
  const RefractionStack::Link& link = this->Links[number];
  const RefractingSurface& surface = *link.Surface;
  const glm::dvec3 shift = this->Origin + link.Shift;
  const double side = link.Passage.FromFront ? 1.0 : -1.0;
  // A ray that may cross the surface again is searched for.
  CrossingChain* chain =
    this->Chain && surface.IsCrossedOnce(direction) ? &(*this->Chain)[link.Index] : nullptr;
  const bool isNear = chain && chain->Follow(surface.GetPatches(), origin - shift, direction, at) &&
    side * glm::dot(at.Normal, direction) < 0.0;
  if (!isNear &&
    !this->Search(link, origin - shift, direction, glm::dot(near - origin, direction), chain, at))
  {
    return false;
  }
  at.Position += shift;
  at.Normal *= side;
  return true;
}

//------------------------------------------------------------------------------
void TraceSightRay(const RefractionStack& stack, double medium, const glm::dvec3& direction,
  StackSightRay& ray, StackChain* chain)
{
  const std::vector<RefractionStack::Link>& links = stack.GetLinks();
  const StackPatches surfaces(links, stack.GetOrigin(), chain);
  const glm::dvec3 eye = stack.GetEye() + stack.GetOrigin();
  constexpr double endless = std::numeric_limits<double>::infinity();
  const std::size_t begin = links.empty() ? 0 : GetSide(links.front(), false);
  // Legs of the ray before are overwritten in place.
  ray.Legs.resize(links.size() + 1);
  ray.Legs.front() = { eye, direction, links.empty() ? medium : links.front().Passage.Before,
    endless, { begin, begin } };
  ray.End = PathEnd::Passed;
  for (std::size_t k = 0; k < links.size(); ++k)
  {
    SightLeg& leg = ray.Legs[k];
    PatchPoint at;
    RefractionRay refracted{ {}, RayKind::BackFacing };
    const InterfacePassage& passage = links[k].Passage;
    ray.End = PathEnd::Missed;
    if (surfaces.Meet(k, leg.Origin, leg.Direction, leg.Origin, at))
    {
      leg.Length = glm::length(at.Position - leg.Origin);
      refracted = ComputeRefractionRay(leg.Direction, at.Normal, links[k].Ratio);
      ray.End = refracted.Kind == RayKind::Refracted ? PathEnd::Passed : PathEnd::Reflected;
    }
    if (ray.End != PathEnd::Passed)
    {
      ray.Legs.resize(k + 1);
      return;
    }
    const std::size_t behind = GetSide(links[k], true);
    const std::size_t next = k + 1 < links.size() ? GetSide(links[k + 1], false) : behind;
    ray.Legs[k + 1] = { at.Position, refracted.Direction, passage.Behind, endless,
      { behind, next } };
  }
}

//------------------------------------------------------------------------------
EyeStatus SightRayTracer::SetEye(const glm::dvec3& eye)
{
  if (!this->HasEye || eye != this->Eye)
  {
    this->Status = this->Stack.SetEye(eye);
    this->Eye = eye;
    this->HasEye = true;
  }
  return this->Status;
}

//------------------------------------------------------------------------------
SightRayTracer& EyeTracers::Get(const glm::dvec3& eye)
{
  const auto known = std::find(this->Eyes.begin(), this->Eyes.end(), eye);
  if (known != this->Eyes.end())
  {
    return this->Tracers[static_cast<std::size_t>(known - this->Eyes.begin())];
  }
  if (this->Eyes.size() < Most)
  {
    this->Eyes.push_back(eye);
    this->Tracers.push_back(this->Unused);
    return this->Tracers.back();
  }
  this->Next = (this->Next + 1) % Most;
  this->Eyes[this->Next] = eye;
  return this->Tracers[this->Next];
}

}
