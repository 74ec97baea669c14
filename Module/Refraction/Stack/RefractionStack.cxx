// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/RefractionStack.h"

#include "Refraction/Stack/StackPassage.h"
#include "Refraction/Surface/CurveCrossings.h"
#include "Refraction/Surface/PatchCrossings.h"

#include <algorithm>

namespace meniscus
{
namespace
{

// Patches to go through from the crossing of an earlier path, and facets on the straight way to
// the next one. For longer ways the tree is faster.
constexpr int LongestChase = 4;
constexpr int LongestWalk = 16;

// Facets that a single step to a surface may be long: beyond, the place of the last trace says
// nothing about the crossing.
constexpr double LongestStep = 4.0;

// Two crossings are the same if they are closer than this fraction of the patch's size. Crossings
// at a common edge of two patches may differ by the effect of Border in both.
constexpr double SamePlace = 4.0 * PatchCrossings::Border;

const CurvedPatch& Hold(const RefractionStack::Link& link, std::int32_t facet, HeldPatch& held)
{
  if (held.Facet != facet)
  {
    held = { facet, link.Surface->GetPatch(facet, !link.Passage.FromFront) };
  }
  return held.Patch;
}

}

//------------------------------------------------------------------------------
MediaChain RefractionStack::SetInterfaces(const std::vector<Interface>& list)
{
  std::vector<InterfaceMedia> media;
  media.reserve(list.size());
  for (const Interface& interface : list)
  {
    media.push_back(interface.Media);
  }
  const MediaChain chain(media);
  this->List = list;
  this->Ways = chain.Ways;
  this->Links.clear();
  // Interfaces that do not refract must not change a bit, so they do not give the origin.
  const auto refracts = [](const Interface& interface) { return interface.Media.IsRefracting(); };
  const auto first = std::find_if(list.begin(), list.end(), refracts);
  this->Origin = first == list.end() ? glm::dvec3(0.0) : first->Surface->GetMembrane().GetOrigin();
  this->NumberOfInterfaces =
    static_cast<std::size_t>(std::count_if(list.begin(), list.end(), refracts));
  if (chain.Fault != MediaFault::None)
  {
    this->List.clear();
    this->NumberOfInterfaces = 0;
  }
  return chain;
}

//------------------------------------------------------------------------------
void RefractionStack::ListLinks(
  const MediaChain::Way& way, std::size_t first, std::vector<Link>& links) const
{
  links.clear();
  std::size_t refracting = 0;
  for (std::size_t i = 0; i < way.size(); ++i)
  {
    if (way[i].Before != way[i].Behind && refracting++ >= first)
    {
      const std::shared_ptr<const RefractingSurface>& surface = this->List[i].Surface;
      links.push_back({ surface, way[i], surface->GetMembrane().GetOrigin() - this->Origin, i,
        way[i].Before / way[i].Behind });
    }
  }
}

//------------------------------------------------------------------------------
EyeStatus RefractionStack::SetEye(const glm::dvec3& eye)
{
  const EyeStatus status = CheckEye(eye, 1.0, 1.0);
  if (status != EyeStatus::Ready)
  {
    return status;
  }
  this->Eye = eye - this->Origin;
  if (std::any_of(this->List.begin(), this->List.end(),
        [&eye](const Interface& interface)
        {
          const RefractingSurface& surface = *interface.Surface;
          return interface.Media.IsRefracting() &&
            surface.IsOnSurface(eye - surface.GetMembrane().GetOrigin());
        }))
  {
    return EyeStatus::OnTheMembrane;
  }
  this->Passes = false;
  this->Links.clear();
  for (std::size_t first = 0; first < this->NumberOfInterfaces && !this->Passes; ++first)
  {
    for (const MediaChain::Way& way : this->Ways)
    {
      this->ListLinks(way, first, this->Links);
      this->Passes = StackPassage(*this).Find();
      if (this->Passes)
      {
        break;
      }
    }
  }
  if (!this->Passes && !this->Ways.empty())
  {
    this->ListLinks(this->Ways.front(), 0, this->Links);
  }
  return EyeStatus::Ready;
}

//------------------------------------------------------------------------------
// The crossing near an earlier one, by Newton's method across patches.
bool RefractionStack::MeetNear(
  const Link& link, const RayJet& ray, PathPoint& point, CurvedPatch& patch, PatchJet& jet) const
{
  StackPlace& place = point.Place;
  const CurvedPatches& patches = link.Surface->GetPatches();
  const glm::dvec3 origin = ray.Origin - link.Shift;
  for (int i = 0; i < LongestChase; ++i)
  {
    patch = link.Surface->GetPatch(place.Facet, !link.Passage.FromFront);
    // The direction is scaled to the distance of the patch, so that the parameter is about 1.
    const double distance = glm::dot(patch.GetFlatPoint(place.B) - origin, ray.Direction);
    if (!(distance > 0.0))
    {
      return false;
    }
    double l = 1.0;
    if (!MeetPatch(patch, { origin, distance * ray.Direction }, place.B, l, jet))
    {
      return false;
    }
    if (FindOutside(place.B).Least >= -PatchCrossings::Border)
    {
      return l > 0.0 && glm::dot(ray.Direction, jet.Normal) < 0.0;
    }
    const glm::dvec3 target = patch.GetFlatPoint(place.B);
    const std::int32_t next = patches.Walk(place.Facet, target, ray.Direction, LongestWalk);
    if (next == place.Facet)
    {
      return false;
    }
    place.Facet = next;
    place.B = patches.GetPatch(next).ProjectToFacet(target);
  }
  return false;
}

//------------------------------------------------------------------------------
bool RefractionStack::FindNext(std::size_t link, const glm::dvec3& origin,
  const glm::dvec3& direction, SurfaceCrossing& crossing, double most) const
{
  const Link& next = this->Links[link];
  return next.FindCrossing(origin - next.Shift, direction, 0.0, crossing, most);
}

//------------------------------------------------------------------------------
// Surfaces that touch may have the crossing before the origin, within rounding of both.
bool RefractionStack::Link::FindCrossing(const glm::dvec3& origin, const glm::dvec3& direction,
  double least, SurfaceCrossing& crossing, double most) const
{
  return this->Surface->FindCrossing(origin, direction, this->Passage.FromFront ? -1 : 1,
    least - this->Surface->GetSlack(glm::length(origin)), most, crossing);
}

//------------------------------------------------------------------------------
auto RefractionStack::MakeMeeting(bool follows) const
{
  return [this, follows](std::size_t index, const RayJet& ray, PathPoint& point, PatchJet& jet,
           PlaceGradient& gradient)
  {
    const bool isMet = this->Meet(index, ray, follows, point, jet);
    gradient = isMet ? GetPlaceGradient(jet, ray.Direction) : gradient;
    return isMet;
  };
}

//------------------------------------------------------------------------------
bool RefractionStack::Meet(
  std::size_t index, const RayJet& ray, bool follows, PathPoint& point, PatchJet& jet) const
{
  const Link& link = this->Links[index];
  CurvedPatch patch;
  const bool isNearest = follows || link.Surface->IsCrossedOnce(ray.Direction);
  if (isNearest && point.Place.Facet != CurvedPatches::NoFacet &&
    this->MeetNear(link, ray, point, patch, jet))
  {
    return true;
  }
  SurfaceCrossing crossing;
  if (!this->FindNext(index, ray.Origin, ray.Direction, crossing))
  {
    return false;
  }
  point.Place = { crossing.Facet, crossing.B };
  patch = link.Surface->GetPatch(crossing.Facet, !link.Passage.FromFront);
  const double scale = std::max(patch.GetSize(), crossing.Distance);
  double l = crossing.Distance / scale;
  return MeetPatch(
    patch, { ray.Origin - link.Shift, scale * ray.Direction }, point.Place.B, l, jet);
}

//------------------------------------------------------------------------------
// One step of Newton's method to the ray's crossing with the surface, across patches.
bool RefractionStack::StepTo(const Link& link, const RayJet& ray, PathPoint& point, PatchJet& jet,
  PlaceGradient& gradient, HeldPatch& held, double& off) const
{
  StackPlace& place = point.Place;
  const CurvedPatches& patches = link.Surface->GetPatches();
  const glm::dvec3 origin = ray.Origin - link.Shift;
  for (int i = 0; i < LongestChase; ++i)
  {
    const CurvedPatch& patch = Hold(link, place.Facet, held);
    patch.Evaluate(place.B, jet);
    gradient = GetPlaceGradient(jet, ray.Direction);
    const glm::dvec3 rest = origin - jet.Position;
    const glm::dvec2 move(glm::dot(gradient.U, rest), glm::dot(gradient.V, rest));
    const double size = GetLargest(move);
    // Written so that a NaN fails.
    if (!(size <= LongestStep))
    {
      return false;
    }
    place.B += move;
    if (FindOutside(place.B).Least >= -PatchCrossings::Border)
    {
      jet.Position += move.x * jet.PositionBy[0] + move.y * jet.PositionBy[1];
      jet.Normal = jet.Normal + move.x * jet.NormalBy[0] + move.y * jet.NormalBy[1];
      off = std::max(off, size);
      return glm::dot(jet.Position - origin, ray.Direction) > 0.0 &&
        glm::dot(ray.Direction, jet.Normal) < 0.0;
    }
    const glm::dvec3 target = patch.GetFlatPoint(place.B);
    const std::int32_t next = patches.Walk(place.Facet, target, ray.Direction, LongestWalk);
    if (next == place.Facet)
    {
      return false;
    }
    place.Facet = next;
    place.B = patches.GetPatch(next).ProjectToFacet(target);
  }
  return false;
}

//------------------------------------------------------------------------------
PathEnd RefractionStack::TraceStep(const StackPlace& first, std::size_t count, StackPath& path,
  std::vector<HeldPatch>& held, double& off) const
{
  PatchJet jet;
  Hold(this->Links.front(), first.Facet, held.front()).Evaluate(first.B, jet);
  off = 0.0;
  return this->TraceOn(first, jet, count, path,
    [this, &held, &off](
      std::size_t index, const RayJet& ray, PathPoint& point, PatchJet& at, PlaceGradient& gradient)
    { return this->StepTo(this->Links[index], ray, point, at, gradient, held[index], off); });
}

//------------------------------------------------------------------------------
PathEnd RefractionStack::Trace(
  const StackPlace& first, std::size_t count, bool follows, StackPath& path) const
{
  const Link& link = this->Links.front();
  PatchJet jet;
  link.Surface->GetPatch(first.Facet, !link.Passage.FromFront).Evaluate(first.B, jet);
  return this->TraceOn(first, jet, count, path, this->MakeMeeting(follows));
}

//------------------------------------------------------------------------------
PathEnd RefractionStack::TraceFrom(
  const StackPlace& first, const PatchPoint& at, std::size_t count, StackPath& path) const
{
  PatchJet jet;
  jet.Position = at.Position;
  jet.Normal = at.Normal;
  for (int k = 0; k < 2; ++k)
  {
    jet.PositionBy[k] = glm::dvec3(0.0);
    jet.NormalBy[k] = glm::dvec3(0.0);
  }
  path.Forget(this->Links.size());
  return this->TraceOn(first, jet, count, path, this->MakeMeeting(false));
}

//------------------------------------------------------------------------------
template <typename Meeting>
PathEnd RefractionStack::TraceOn(const StackPlace& first, PatchJet& jet, std::size_t count,
  StackPath& path, const Meeting& meet) const
{
  path.Points.resize(this->Links.size());
  path.Count = 0;
  RayJet ray;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Link& link = this->Links[i];
    PathPoint& point = path.Points[i];
    VectorBy normalBy;
    PlaceGradient gradient;
    if (i == 0)
    {
      jet.Position += link.Shift;
      ray = MakeSightRay(this->Eye, jet);
      path.Sight = ray.Direction;
      path.SightBy = ray.DirectionBy;
      point.Place = first;
      point.By = { NumberBy{ 1.0, 0.0 }, NumberBy{ 0.0, 1.0 } };
      normalBy = MakeVectorBy(jet.NormalBy);
    }
    else if (meet(i, ray, point, jet, gradient))
    {
      jet.Position += link.Shift;
      point.By = Transfer(ray, jet, gradient);
      normalBy = Chain(jet.NormalBy, point.By);
    }
    else
    {
      return PathEnd::Missed;
    }
    const bool isRefracted =
      Refract(ray, jet.Normal, normalBy, link.Ratio, point.Cosine) == RayKind::Refracted;
    point.Ray = ray;
    if (!isRefracted)
    {
      return PathEnd::Reflected;
    }
    path.Count = i + 1;
  }
  return PathEnd::Passed;
}

//------------------------------------------------------------------------------
bool RefractionStack::IsFirstCrossing(const StackPath& path) const
{
  for (std::size_t i = 1; i < path.Count; ++i)
  {
    const Link& link = this->Links[i];
    const PathPoint& point = path.Points[i];
    const glm::dvec3 origin = path.Points[i - 1].Ray.Origin - link.Shift;
    const glm::dvec3 leg = point.Ray.Origin - link.Shift - origin;
    const double length = glm::length(leg);
    if (length > 0.0 && link.Surface->IsCrossedOnce(leg / length))
    {
      continue;
    }
    const double same =
      SamePlace * link.Surface->GetPatches().GetPatch(point.Place.Facet).GetSize();
    SurfaceCrossing crossing;
    if (length > same &&
      link.Surface->FindCrossing(
        origin, leg / length, link.Passage.FromFront ? -1 : 1, 0.0, length - same, crossing))
    {
      return false;
    }
  }
  return true;
}

}
