// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackTubes.h"

#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

DirectionBox MakeDirectionBox(const TubeBounds& tube)
{
  return { 0.5 * (tube.DirectionLow + tube.DirectionHigh),
    0.5 * (tube.DirectionHigh - tube.DirectionLow) };
}

void Move(TubeBounds& bounds, const glm::dvec3& shift)
{
  if (bounds.IsValid())
  {
    bounds.StartLow += shift;
    bounds.StartHigh += shift;
  }
}

// Box of the rays of `tube` between the two ends of `range`.
AxisBox BoundPart(const TubeBounds& tube, const TubeRange& range)
{
  AxisBox box;
  for (const double t : { range.From, range.To })
  {
    box.Add({ tube.StartLow + t * tube.DirectionLow, tube.StartHigh + t * tube.DirectionHigh });
  }
  return box;
}

// Bounds of the normals of a patch on the side from which rays pass.
DirectionBox GetNormals(const RefractionStack::Link& link, std::int32_t facet)
{
  DirectionBox normals = link.Surface->GetBounds(facet).Normals;
  normals.Middle *= link.Passage.FromFront ? 1.0 : -1.0;
  return normals;
}

// The normals of a patch are of second degree, so those of a triangle in it are in the hull of the
// control points that follow from its corners and the middles of its sides.
DirectionBox BoundTriangleNormals(const CurvedPatch& patch, const PatchTriangle& corners)
{
  glm::dvec3 normals[6];
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& a = corners[(k + 1) % 3];
    const glm::dvec2& b = corners[(k + 2) % 3];
    normals[k] = patch.GetNormal(corners[k]);
    normals[k + 3] =
      2.0 * patch.GetNormal(0.5 * (a + b)) - 0.5 * (patch.GetNormal(a) + patch.GetNormal(b));
  }
  return BoundDirections((normals[0] + normals[1] + normals[2]) / 3.0, normals, 6, 0.0);
}

/** Part of a patch that the rays of a tube may meet. */
struct MetPart
{
  AxisBox Box;
  DirectionBox Normals; ///< on the side from which rays pass
};

// True if the tube is so narrow next to the patch that it may be worth while to bound its part.
bool IsNarrow(const TubeBounds& tube, const TubeRange& range, const AxisBox& patch)
{
  constexpr double narrow = 0.5; // another value changes the time only
  const glm::dvec3 across =
    tube.StartHigh - tube.StartLow + range.From * (tube.DirectionHigh - tube.DirectionLow);
  const glm::dvec3 size = patch.High - patch.Low;
  return std::max({ across.x, across.y, across.z }) < narrow * std::max({ size.x, size.y, size.z });
}

// Reduces the range of a tube to its rays' parameters within `bulge` of the plane through `point`
// with the unit normal `normal`.
void ClipToPlane(const TubeBounds& tube, const glm::dvec3& point, const glm::dvec3& normal,
  double bulge, TubeRange& range)
{
  const glm::dvec3 reach = glm::abs(normal);
  const auto project = [&normal, &reach](const glm::dvec3& low, const glm::dvec3& high)
  {
    const double middle = glm::dot(normal, 0.5 * (low + high));
    const double half = glm::dot(reach, 0.5 * (high - low));
    return glm::dvec2(middle - half, middle + half);
  };
  const glm::dvec2 height = project(tube.StartLow - point, tube.StartHigh - point);
  const glm::dvec2 rate = project(tube.DirectionLow, tube.DirectionHigh);
  if (rate.x <= 0.0 && rate.y >= 0.0)
  {
    return; // rays may run along the plane
  }
  const double ways[2] = { -bulge - height.y, bulge - height.x };
  const auto [least, most] =
    std::minmax({ ways[0] / rate.x, ways[0] / rate.y, ways[1] / rate.x, ways[1] / rate.y });
  range.From = std::max(range.From, least);
  range.To = std::min(range.To, most);
}

// The triangle in a patch that holds all of its points in a box. Returns false if there are none.
// Points of the patch are within `bulge` of those of the facet with the same coordinates.
bool BoundPlaces(const CurvedPatch& patch, const AxisBox& box, double bulge, PatchTriangle& corners)
{
  const glm::dvec3 u = patch.Corner[1] - patch.Corner[0];
  const glm::dvec3 v = patch.Corner[2] - patch.Corner[0];
  const glm::dvec3 normal = glm::cross(u, v);
  const double squared = glm::dot(normal, normal);
  const glm::dvec3 byX = glm::cross(v, normal) / squared;
  const glm::dvec3 byY = glm::cross(normal, u) / squared;
  const glm::dvec3 middle = 0.5 * (box.Low + box.High) - patch.Corner[0];
  const glm::dvec3 half = 0.5 * (box.High - box.Low);
  const auto getLeast = [&middle, &half, bulge](double at, const glm::dvec3& by)
  {
    return std::max(
      at + glm::dot(by, middle) - glm::dot(glm::abs(by), half) - bulge * glm::length(by), 0.0);
  };
  const glm::dvec2 low(getLeast(0.0, byX), getLeast(0.0, byY));
  const double size = 1.0 - low.x - low.y - getLeast(1.0, -byX - byY);
  corners = { low, low + glm::dvec2(size, 0.0), low + glm::dvec2(0.0, size) };
  // Written so that a NaN passes: a facet without area has no coordinates.
  return !(size < 0.0);
}

// Returns false if no ray of the tube, in coordinates of the surface and with the directions
// `sight`, meets the patch from the right side.
bool BoundMetPart(const RefractionStack::Link& link, std::int32_t facet, const TubeBounds& tube,
  const DirectionBox& sight, TubeRange range, MetPart& part)
{
  const RefractingSurface::PatchBounds& bounds = link.Surface->GetBounds(facet);
  part.Normals = GetNormals(link, facet);
  if (!(BoundCosine(sight, part.Normals).Least < 0.0))
  {
    return false;
  }
  const bool isNarrow = IsNarrow(tube, range, bounds.Box);
  CurvedPatch patch;
  if (isNarrow)
  {
    patch = link.Surface->GetPatch(facet, !link.Passage.FromFront);
    const glm::dvec3 normal =
      glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]);
    ClipToPlane(tube, patch.Corner[0], glm::normalize(normal), bounds.Bulge, range);
  }
  part.Box = BoundPart(tube, range);
  part.Box.Low = glm::max(part.Box.Low, bounds.Box.Low);
  part.Box.High = glm::min(part.Box.High, bounds.Box.High);
  if (!isNarrow)
  {
    return true;
  }
  PatchTriangle places;
  if (range.From > range.To || glm::any(glm::greaterThan(part.Box.Low, part.Box.High)) ||
    !BoundPlaces(patch, part.Box, bounds.Bulge, places))
  {
    return false;
  }
  const DirectionBox normals = BoundTriangleNormals(patch, places);
  if (std::max({ normals.Half.x, normals.Half.y, normals.Half.z }) <
    std::max({ part.Normals.Half.x, part.Normals.Half.y, part.Normals.Half.z }))
  {
    part.Normals = normals;
  }
  return BoundCosine(sight, part.Normals).Least < 0.0;
}

// Calls `visit(tube)` with bounds of the rays behind each patch of an interface that the rays of
// `before` meet. Every ray that meets the surface does so in one of the patches that the tube
// meets, inside the tube.
template <typename Visitor>
void VisitNextLegs(
  const RefractionStack::Link& link, const TubeBounds& before, const Visitor& visit)
{
  TubeBounds local = before;
  Move(local, -link.Shift);
  const DirectionBox sight = MakeDirectionBox(before);
  const double ratio = link.Passage.Before / link.Passage.Behind;
  link.Surface->VisitFacets(local,
    [&](std::int32_t facet, const TubeRange& range)
    {
      MetPart part;
      if (!BoundMetPart(link, facet, local, sight, range, part))
      {
        return;
      }
      const glm::dvec3 corners[2] = { part.Box.Low, part.Box.High };
      TubeBounds refracted = BoundRefractedRays(sight, part.Normals, ratio, corners, 2, 0.0);
      if (refracted.IsValid())
      {
        Move(refracted, link.Shift);
        visit(refracted);
      }
    });
}

/** A triangle in a patch of the first surface, as the eye sees it, in coordinates of the surface.
 */
struct SeenTriangle
{
  DirectionBox Sights;
  DirectionBox Normals;
  glm::dvec3 Places[3]; ///< corners in the facet
  double Bulge;         ///< bound of the distance between the patch and its facet
};

SeenTriangle BoundSeenTriangle(
  const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners)
{
  const RefractionStack::Link& first = stack.GetLinks().front();
  const CurvedPatch patch = first.Surface->GetPatch(facet, !first.Passage.FromFront);
  const glm::dvec3 eye = stack.GetEye() - first.Shift;
  SeenTriangle seen;
  seen.Bulge = first.Surface->GetBounds(facet).Bulge;
  glm::dvec3 sights[3];
  for (std::size_t k = 0; k < 3; ++k)
  {
    seen.Places[k] = patch.GetFlatPoint(corners[k]);
    sights[k] = seen.Places[k] - eye;
  }
  seen.Sights = BoundDirections((sights[0] + sights[1] + sights[2]) / 3.0, sights, 3, seen.Bulge);
  seen.Normals = BoundTriangleNormals(patch, corners);
  return seen;
}

}

//------------------------------------------------------------------------------
TubeBounds BoundNextLeg(const RefractionStack::Link& link, const TubeBounds& before)
{
  TubeBounds bounds;
  VisitNextLegs(link, before, [&bounds](const TubeBounds& refracted) { bounds.Add(refracted); });
  return bounds;
}

//------------------------------------------------------------------------------
TubeBounds BoundStackRays(
  const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners, std::size_t count)
{
  const RefractionStack::Link& first = stack.GetLinks().front();
  const SeenTriangle seen = BoundSeenTriangle(stack, facet, corners);
  TubeBounds tube = BoundRefractedRays(seen.Sights, seen.Normals,
    first.Passage.Before / first.Passage.Behind, seen.Places, 3, seen.Bulge);
  Move(tube, first.Shift);
  for (std::size_t k = 1; k < count && tube.IsValid(); ++k)
  {
    tube = BoundNextLeg(stack.GetLinks()[k], tube);
  }
  return tube;
}

//------------------------------------------------------------------------------
bool MayMeet(const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners,
  std::size_t surface)
{
  if (surface == 0)
  {
    const SeenTriangle seen = BoundSeenTriangle(stack, facet, corners);
    return BoundCosine(seen.Sights, seen.Normals).Least < 0.0;
  }
  TubeBounds tube = BoundStackRays(stack, facet, corners, surface);
  if (!tube.IsValid())
  {
    return false;
  }
  const RefractionStack::Link& link = stack.GetLinks()[surface];
  const DirectionBox sight = MakeDirectionBox(tube);
  Move(tube, -link.Shift);
  bool meets = false;
  link.Surface->VisitFacets(tube,
    [&](std::int32_t other, const TubeRange& range)
    {
      MetPart part;
      meets = meets || BoundMetPart(link, other, tube, sight, range, part);
    });
  return meets;
}

//------------------------------------------------------------------------------
// Behind the last interface each of its patches has a tube of its own: together they are narrower
// than bounds of all rays.
bool MayReach(const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners,
  std::size_t count, const AxisBox& box)
{
  const auto holds = [&box](const TubeBounds& tube)
  {
    const TubeRange range = TubeClip(tube).Clip(box, std::numeric_limits<double>::max());
    return range.From <= range.To;
  };
  const TubeBounds tube =
    BoundStackRays(stack, facet, corners, std::max<std::size_t>(count, 2) - 1);
  if (!tube.IsValid() || count == 1)
  {
    return tube.IsValid() && holds(tube);
  }
  bool reaches = false;
  VisitNextLegs(stack.GetLinks()[count - 1], tube,
    [&reaches, &holds](const TubeBounds& refracted) { reaches = reaches || holds(refracted); });
  return reaches;
}

}
