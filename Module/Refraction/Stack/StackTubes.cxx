// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackTubes.h"

#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/common.hpp>

namespace meniscus
{
namespace
{

DirectionBox MakeDirectionBox(const TubeBounds& tube)
{
  return { 0.5 * (tube.DirectionLow + tube.DirectionHigh),
    0.5 * (tube.DirectionHigh - tube.DirectionLow) };
}

void Merge(TubeBounds& bounds, const TubeBounds& other)
{
  bounds.StartLow = glm::min(bounds.StartLow, other.StartLow);
  bounds.StartHigh = glm::max(bounds.StartHigh, other.StartHigh);
  bounds.DirectionLow = glm::min(bounds.DirectionLow, other.DirectionLow);
  bounds.DirectionHigh = glm::max(bounds.DirectionHigh, other.DirectionHigh);
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

/** A triangle in a patch of the first surface, as the eye sees it, in coordinates of the surface.
 */
struct SeenTriangle
{
  DirectionBox Sights;
  DirectionBox Normals;
  glm::dvec3 Places[3]; ///< corners in the facet
  double Bulge;         ///< bound of the distance between the patch and its facet
};

// The normals of a patch are of second degree, so those of the triangle are in the hull of the
// control points that follow from its corners and the middles of its sides.
SeenTriangle BoundSeenTriangle(
  const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners)
{
  const RefractionStack::Link& first = stack.GetLinks().front();
  const CurvedPatch patch = first.Surface->GetPatch(facet, !first.Passage.FromFront);
  const glm::dvec3 eye = stack.GetEye() - first.Shift;
  SeenTriangle seen;
  seen.Bulge = first.Surface->GetBounds(facet).Bulge;
  glm::dvec3 normals[6];
  glm::dvec3 sights[3];
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& a = corners[(k + 1) % 3];
    const glm::dvec2& b = corners[(k + 2) % 3];
    normals[k] = patch.GetNormal(corners[k]);
    normals[k + 3] =
      2.0 * patch.GetNormal(0.5 * (a + b)) - 0.5 * (patch.GetNormal(a) + patch.GetNormal(b));
    seen.Places[k] = patch.GetFlatPoint(corners[k]);
    sights[k] = seen.Places[k] - eye;
  }
  seen.Sights = BoundDirections((sights[0] + sights[1] + sights[2]) / 3.0, sights, 3, seen.Bulge);
  seen.Normals = BoundDirections((normals[0] + normals[1] + normals[2]) / 3.0, normals, 6, 0.0);
  return seen;
}

}

//------------------------------------------------------------------------------
// Every ray of `before` that meets the next surface does so in one of the patches that the tube
// meets, inside the tube.
TubeBounds BoundNextLeg(const RefractionStack::Link& link, const TubeBounds& before)
{
  TubeBounds local = before;
  Move(local, -link.Shift);
  const DirectionBox sight = MakeDirectionBox(before);
  const double ratio = link.Passage.Before / link.Passage.Behind;
  TubeBounds bounds;
  link.Surface->VisitFacets(local,
    [&](std::int32_t facet, const TubeRange& range)
    {
      const AxisBox& box = link.Surface->GetBounds(facet).Box;
      const AxisBox part = BoundPart(local, range);
      const glm::dvec3 corners[2] = { glm::max(part.Low, box.Low), glm::min(part.High, box.High) };
      const TubeBounds refracted =
        BoundRefractedRays(sight, GetNormals(link, facet), ratio, corners, 2, 0.0);
      if (refracted.IsValid())
      {
        Merge(bounds, refracted);
      }
    });
  Move(bounds, link.Shift);
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
bool MayMeetLast(const RefractionStack& stack, std::int32_t facet, const PatchTriangle& corners)
{
  const std::size_t last = stack.GetLinks().size() - 1;
  if (last == 0)
  {
    const SeenTriangle seen = BoundSeenTriangle(stack, facet, corners);
    return BoundCosine(seen.Sights, seen.Normals).Least < 0.0;
  }
  TubeBounds tube = BoundStackRays(stack, facet, corners, last);
  if (!tube.IsValid())
  {
    return false;
  }
  const RefractionStack::Link& link = stack.GetLinks()[last];
  const DirectionBox sight = MakeDirectionBox(tube);
  Move(tube, -link.Shift);
  bool meets = false;
  link.Surface->VisitFacets(tube,
    [&](std::int32_t other, const TubeRange&)
    { meets = meets || BoundCosine(sight, GetNormals(link, other)).Least < 0.0; });
  return meets;
}

}
