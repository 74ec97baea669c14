// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/StackVisibility.h"

#include "Common/Prefetch.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
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

TubeBounds Moved(TubeBounds tube, const glm::dvec3& by)
{
  tube.StartLow += by;
  tube.StartHigh += by;
  return tube;
}

/** Bounds of the normals at intersections with a patch. */
AxisBox NormalsOf(const RefractingSurface::PatchBounds& patch)
{
  const glm::dvec3 half = patch.Normals.Half + PatchIntersector::NormalMargin;
  return { patch.Normals.Middle - half, patch.Normals.Middle + half };
}

/** A facet whose box rays of a tube may meet. */
struct FoundFacet
{
  std::int32_t Facet;
  TubeRange Range;
};

/** Unit vectors in a box. */
DirectionBox InBox(const glm::dvec3& low, const glm::dvec3& high)
{
  return { 0.5 * (low + high), 0.5 * (high - low) };
}

}

//------------------------------------------------------------------------------
bool VisibilityBounds::MeetsBox(const TubeBounds& tube, double last) const
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
/** A ray that meets the geometry from outside of the box, or does not end, passes its boundary. */
bool VisibilityBounds::Meets(const TubeBounds& tube, InstructionSet set, double last) const
{
  const glm::dvec3 beyond =
    glm::max(tube.StartLow - this->Center, this->Center - tube.StartHigh) - this->Half;
  const bool passes = last == std::numeric_limits<double>::infinity() ||
    std::max(std::max(beyond.x, beyond.y), beyond.z) > 0.0;
  bool meets = this->MeetsBox(tube, last);
  if (meets && passes && this->Parts.Count > 0)
  {
    meets = false;
    VisitBoxes(tube, set, this->Parts,
      [&meets, last](std::int32_t, const TubeRange& range) { meets |= range.From <= last; });
  }
  return meets;
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
  const glm::dvec3 toSurface = this->ToSurface(interface);
  const TubeBounds shifted = Moved(tube, toSurface);
  Meeting meeting;
  const auto meet = [&](const FoundFacet& found)
  {
    const RefractingSurface::PatchBounds& patch = interface.Surface->GetBounds(found.Facet);
    const AxisBox normals = NormalsOf(patch);
    const auto mayFace = [&]()
    {
      const CosineBounds cosine = BoundCosine(sight, InBox(normals.Low, normals.High));
      return (facing > 0.0 ? cosine.Most : -cosine.Least) > 0.0;
    };
    if (facing == 0.0 || mayFace())
    {
      const AxisBox part = BoundPart(shifted, found.Range);
      meeting.Exists = true;
      meeting.Places.Add({ glm::max(part.Low, patch.Box.Low) - toSurface,
        glm::min(part.High, patch.Box.High) - toSurface });
      meeting.Normals.Add(normals);
      meeting.Last = std::max(meeting.Last, found.Range.To);
      facets.Add(found.Facet, patch.Box);
    }
  };
  // Bounds of patches are far apart in memory: they are requested a few facets before their use.
  std::array<FoundFacet, 8> waiting;
  std::size_t count = 0;
  const auto add = [&](std::int32_t facet, const TubeRange& range)
  {
    Prefetch(&interface.Surface->GetBounds(facet), sizeof(RefractingSurface::PatchBounds));
    FoundFacet& place = waiting[count % waiting.size()];
    if (count >= waiting.size())
    {
      meet(place);
    }
    place = { facet, range };
    ++count;
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
  for (std::size_t k = count - std::min(count, waiting.size()); k < count; ++k)
  {
    meet(waiting[k % waiting.size()]);
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
  TubeBounds tube;
  for (int i = 0; i < 4; ++i)
  {
    tube.Add(rays.Starts[i], rays.Directions[i]);
  }
  return this->Mesh.Meets(tube, this->Set);
}

//------------------------------------------------------------------------------
bool StackVisibility::CornersMeetBoundsUnrefracted(const CornerRays& rays) const
{
  for (int i = 0; i < 4; ++i)
  {
    TubeBounds ray;
    ray.Add(rays.Starts[i], rays.Directions[i]);
    if (!this->Mesh.Meets(ray, this->Set))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/**
 * Among the rays of a rectangle of pixels, those that meet the surface end where they pass an edge
 * of the surface, are along it, or meet it at their beginning. Without such a place all or none
 * meet it. None is along it, since MayShowMesh() is true where rays may come from both sides.
 */
bool StackVisibility::HidesMesh(const CornerRays& rays, FacetBoxes& facets) const
{
  const RefractingSurface& surface = *this->Interfaces.front().Surface;
  const TubeBounds tube = BoundSight(rays);
  const glm::dvec3 toSurface = this->ToSurface(this->Interfaces.front());
  bool mayEnd = false;
  double last = 0.0;
  VisitBoxes(Moved(tube, toSurface), this->Set, facets,
    [&](std::int32_t facet, const TubeRange& range)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        mayEnd |= surface.GetPatches().GetNeighbour(facet, corner) == CurvedPatches::NoFacet;
      }
      mayEnd |= !(range.From > 0.0);
      last = std::max(last, range.To);
    });
  return !mayEnd && !this->MeetsBounds(tube, last);
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
    mayShow = mayShow || (k > 0 && this->MeetsBounds(tube, meeting.Last));
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
  return mayShow || (tube.IsValid() && this->Mesh.Meets(tube, this->Set));
}

}
