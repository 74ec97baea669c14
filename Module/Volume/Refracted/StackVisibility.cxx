// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/StackVisibility.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

/** Box around the points of a tube between two parameters; the last one may be infinite. */
AxisBox BoundPart(const TubeBounds& tube, const TubeRange& range)
{
  AxisBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = tube.DirectionLow[axis];
    const double high = tube.DirectionHigh[axis];
    box.Low[axis] = tube.StartLow[axis] + (low < 0.0 ? low * range.To : low * range.From);
    box.High[axis] = tube.StartHigh[axis] + (high > 0.0 ? high * range.To : high * range.From);
  }
  return box;
}

/** Tube around the rays of a rectangle of pixels. */
TubeBounds BoundSight(const CornerRays& rays)
{
  const auto& along = rays.Directions;
  const DirectionBox sight =
    BoundDirections(0.25 * (along[0] + along[1] + along[2] + along[3]), along, 4, 0.0);
  return BoundRays(sight.Middle - sight.Half, sight.Middle + sight.Half, rays.Starts, 4, 0.0);
}

/** Unit vectors in a box. */
DirectionBox InBox(const glm::dvec3& low, const glm::dvec3& high)
{
  return { 0.5 * (low + high), 0.5 * (high - low) };
}

}

//------------------------------------------------------------------------------
bool VisibilityBounds::Meets(const TubeBounds& tube, double last) const
{
  double first = 0.0;
  const auto constrain = [&first, &last](double offset, double rate)
  {
    // offset + t rate >= 0
    first = rate > 0.0 ? std::max(first, -offset / rate) : first;
    last = rate < 0.0 ? std::min(last, -offset / rate) : last;
    last = rate == 0.0 && offset < 0.0 ? -1.0 : last;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    constrain(
      tube.StartHigh[axis] + this->Half[axis] - this->Center[axis], tube.DirectionHigh[axis]);
    constrain(
      this->Center[axis] - tube.StartLow[axis] + this->Half[axis], -tube.DirectionLow[axis]);
  }
  return first <= last;
}

//------------------------------------------------------------------------------
/**
 * @param facing 1 if rays only meet the surface along its normals, -1 if only against them, 0 if
 *   from both sides.
 * @param within facets among which are those that the rays may meet; null for all.
 * @param facets those that they may meet are appended.
 */
StackVisibility::Meeting StackVisibility::Meet(const Interface& interface, const TubeBounds& tube,
  double facing, FacetBoxes* within, FacetBoxes& facets) const
{
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const DirectionBox sight = InBox(tube.DirectionLow, tube.DirectionHigh);
  const glm::dvec3 toSurface = this->Origin - interface.Surface->GetMembrane().GetOrigin();
  TubeBounds shifted = tube;
  shifted.StartLow += toSurface;
  shifted.StartHigh += toSurface;
  Meeting meeting;
  const auto add = [&](std::int32_t facet, const TubeRange& range)
  {
    const RefractingSurface::PatchBounds& patch = interface.Surface->GetBounds(facet);
    const glm::dvec3 half = patch.Normals.Half + PatchIntersector::NormalMargin;
    const CosineBounds cosine = BoundCosine(sight, { patch.Normals.Middle, half });
    const double most = facing > 0.0 ? cosine.Most : -cosine.Least;
    if (facing == 0.0 || most > 0.0)
    {
      const AxisBox part = BoundPart(shifted, range);
      meeting.Exists = true;
      meeting.Places.Add({ glm::max(part.Low, patch.Box.Low) - toSurface,
        glm::min(part.High, patch.Box.High) - toSurface });
      meeting.Normals.Add({ patch.Normals.Middle - half, patch.Normals.Middle + half });
      meeting.Last = std::max(meeting.Last, range.To);
      facets.Add(facet, patch.Box);
    }
    return anywhere;
  };
  if (within)
  {
    VisitBoxes(shifted, this->Set, *within, add);
  }
  else
  {
    interface.Surface->GetTree().Visit(shifted, anywhere, add);
  }
  return meeting;
}

//------------------------------------------------------------------------------
bool StackVisibility::MayShowMesh(const CornerRays& rays, BundleFacets& facets) const
{
  BundleFacets all;
  return this->MayShowMesh(rays, all, facets);
}

//------------------------------------------------------------------------------
bool StackVisibility::MayShowMesh(
  const CornerRays& rays, BundleFacets& within, BundleFacets& facets) const
{
  return this->FollowLegs(0, BoundSight(rays), 0.0, within, facets);
}

//------------------------------------------------------------------------------
bool StackVisibility::MayShowMeshUnrefracted(const CornerRays& rays) const
{
  return this->Mesh.Meets(BoundSight(rays));
}

//------------------------------------------------------------------------------
bool StackVisibility::MayShowMesh(
  const TubeBounds& rays, double medium, BundleFacets& within, BundleFacets& facets) const
{
  return this->FollowLegs(1, rays, medium, within, facets);
}

//------------------------------------------------------------------------------
/**
 * @param number first interface that the rays come to.
 * @param medium medium in front of it; not used for interface 0, which rays may come to in either
 *   of its media.
 */
bool StackVisibility::FollowLegs(std::size_t number, TubeBounds tube, double medium,
  BundleFacets& within, BundleFacets& facets) const
{
  bool mayShow = false;
  facets.Clear(number);
  for (std::size_t k = number; k < this->Interfaces.size() && tube.IsValid(); ++k)
  {
    const Interface& interface = this->Interfaces[k];
    const auto [exterior, interior] = interface.Media;
    if (k > 0 && medium != exterior && medium != interior)
    {
      return true;
    }
    const double facing = medium == exterior ? -1.0 : 1.0;
    const Meeting meeting =
      this->Meet(interface, tube, k == 0 ? 0.0 : facing, within.Find(k), facets.Append());
    if (!meeting.Exists)
    {
      return k > 0;
    }
    mayShow = mayShow || (k > 0 && this->Mesh.Meets(tube, meeting.Last));
    const DirectionBox sight = InBox(tube.DirectionLow, tube.DirectionHigh);
    DirectionBox normal = InBox(meeting.Normals.Low, meeting.Normals.High);
    const CosineBounds cosine = BoundCosine(sight, normal);
    if (k == 0 && !(cosine.Most < 0.0) && !(cosine.Least > 0.0))
    {
      return true; // rays may pass the first surface from both sides
    }
    const bool fromFront = k == 0 ? cosine.Most < 0.0 : facing < 0.0;
    const double before = fromFront ? exterior : interior;
    const double behind = fromFront ? interior : exterior;
    normal.Middle = fromFront ? normal.Middle : -normal.Middle;
    const glm::dvec3 corners[2] = { meeting.Places.Low, meeting.Places.High };
    tube = BoundRefractedRays(sight, normal, before / behind, corners, 2, 0.0);
    medium = behind;
  }
  // Without valid bounds all rays are totally reflected.
  return mayShow || (tube.IsValid() && this->Mesh.Meets(tube));
}

}
