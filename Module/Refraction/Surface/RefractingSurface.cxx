// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Surface/RefractingSurface.h"

#include "Refraction/Surface/CurveCrossings.h"
#include "Refraction/Surface/PatchCrossings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>

namespace meniscus
{
namespace
{

// Slant of most rays. The cheap bound of the largest slant is enough if it is above; another value
// changes the time only.
constexpr double CommonSlant = 4.0;

}

//------------------------------------------------------------------------------
MembraneStatus RefractingSurface::SetMembrane(
  const MembraneInput& input, SurfaceParts parts, const RangeLoop& loop)
{
  static std::atomic<std::int64_t> last{ 0 };
  const std::vector<Membrane::Facet> before = this->Surface.GetFacets();
  const std::size_t pointsBefore = this->Surface.GetPositions().size();
  const MembraneStatus status = this->Surface.Build(input);
  const auto& facets = this->Surface.GetFacets();
  if (facets.empty() || facets != before || this->Surface.GetPositions().size() != pointsBefore)
  {
    this->Topology = ++last;
  }
  this->Shape = ++last;
  this->Parts = SurfaceParts::Facets;
  this->Prepare(parts, loop);
  return status;
}

//------------------------------------------------------------------------------
void RefractingSurface::Prepare(SurfaceParts parts, const RangeLoop& loop)
{
  const auto lacks = [this, parts](SurfaceParts part)
  { return this->Parts < part && part <= parts; };
  if (lacks(SurfaceParts::Patches))
  {
    if (this->PatchesOf == this->Topology)
    {
      this->Patches.Refit(loop);
    }
    else
    {
      this->Patches.Build(this->Surface, loop);
    }
    this->PatchesOf = this->Topology;
  }
  if (lacks(SurfaceParts::Boxes))
  {
    this->BuildBoxes(loop);
  }
  if (lacks(SurfaceParts::Crossings))
  {
    this->BuildCrossings(loop);
  }
  this->Parts = std::max(this->Parts, parts);
}

//------------------------------------------------------------------------------
void RefractingSurface::BuildBoxes(const RangeLoop& loop)
{
  const std::size_t count = this->Surface.GetFacets().size();
  this->Bounds.resize(count);
  std::vector<AxisBox> boxes(count);
  const double slack = this->GetSlack(0.0);
  ForEachItem(count, loop,
    [this, slack, &boxes](std::size_t i)
    {
      const CurvedPatch patch = this->Patches.GetPatch(static_cast<std::int32_t>(i));
      PatchBounds& bounds = this->Bounds[i];
      bounds.Bulge = BoundBulge(patch) + slack;
      bounds.Normals = BoundNormals(patch);
      bounds.Box = AxisBox();
      const double reach = bounds.Bulge + PatchCrossings::Margin * patch.GetSize();
      for (const glm::dvec3& corner : patch.Corner)
      {
        bounds.Box.Add({ corner - reach, corner + reach });
      }
      boxes[i] = bounds.Box;
    });
  AxisBox whole;
  for (const AxisBox& box : boxes)
  {
    whole.Add(box);
  }
  const glm::dvec3 sides = whole.High - whole.Low;
  this->Width = std::max({ 0.0, sides.x, sides.y, sides.z });
  this->Tree.Build(boxes);
}

//------------------------------------------------------------------------------
void RefractingSurface::BuildCrossings(const RangeLoop& loop)
{
  const std::size_t count = this->Surface.GetFacets().size();
  this->Slants.resize(count);
  std::vector<DirectionBox> normals(count);
  ForEachItem(count, loop,
    [this, &normals](std::size_t i)
    {
      const CurvedPatch patch = this->Patches.GetPatch(static_cast<std::int32_t>(i));
      PatchSlant& slant = this->Slants[i];
      slant.Largest = PatchCrossings::BoundLargestSlant(patch);
      if (slant.Largest < CommonSlant)
      {
        slant.Largest = PatchCrossings(patch, HeightFrame()).GetLargestSlant();
      }
      const glm::dvec3 winding = glm::normalize(
        glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]));
      const glm::dvec3 normal = patch.Normal[0] + patch.Normal[1] + patch.Normal[2];
      slant.Facing = glm::dot(winding, normal) < 0.0 ? -winding : winding;
      normals[i] = this->Bounds[i].Normals;
    });
  this->Steep.Build(this->Surface, this->Patches, normals);
}

//------------------------------------------------------------------------------
// With the normals, q changes its sign too, so that its product with the normal does not.
CurvedPatch RefractingSurface::GetPatch(std::int32_t facet, bool flipped) const
{
  CurvedPatch patch = this->Patches.GetPatch(facet);
  for (int k = 0; flipped && k < 3; ++k)
  {
    patch.Normal[k] = -patch.Normal[k];
    patch.Bend[k] = -patch.Bend[k];
    patch.Symmetric[k] = -patch.Symmetric[k];
    patch.Asymmetric[k] = -patch.Asymmetric[k];
  }
  return patch;
}

//------------------------------------------------------------------------------
double RefractingSurface::GetSlack(double distance) const
{
  return this->Surface.GetSlack(distance);
}

//------------------------------------------------------------------------------
bool RefractingSurface::MayCross(
  std::int32_t facet, const HeightFrame& frame, const glm::dvec2& place) const
{
  const auto i = static_cast<std::size_t>(facet);
  const Membrane::Facet& triangle = this->Surface.GetFacets()[i];
  const std::vector<glm::dvec3>& positions = this->Surface.GetPositions();
  return PassesNear({ frame.Project(positions[static_cast<std::size_t>(triangle[0])]),
                      frame.Project(positions[static_cast<std::size_t>(triangle[1])]),
                      frame.Project(positions[static_cast<std::size_t>(triangle[2])]) },
    place, this->Bounds[i].Bulge);
}

//------------------------------------------------------------------------------
bool RefractingSurface::FindCrossing(const glm::dvec3& origin, const glm::dvec3& direction,
  int side, double least, double most, SurfaceCrossing& nearest) const
{
  const HeightFrame frame(direction);
  const glm::dvec2 place = frame.Project(origin);
  const double pad = this->GetSlack(glm::length(origin));
  const TubeBounds ray{ origin - pad, origin + pad, direction, direction };
  nearest.Facet = CurvedPatches::NoFacet;
  this->Tree.Visit(ray, most,
    [&](std::int32_t facet, const TubeRange&)
    {
      const PatchSlant& slant = this->Slants[static_cast<std::size_t>(facet)];
      const double cosine = glm::dot(slant.Facing, direction);
      // Written so that a NaN fails.
      const bool isOnce = slant.Largest * std::fabs(cosine) >= 1.0;
      const bool isOtherWay = isOnce && side * cosine < 0.0;
      if (!isOtherWay && this->MayCross(facet, frame, place))
      {
        this->FindInPatch(facet, origin, frame, side, least, most, nearest);
      }
      return most;
    });
  return nearest.Facet != CurvedPatches::NoFacet;
}

//------------------------------------------------------------------------------
// The place where a line that crosses a patch once at most meets the surface of which the patch is
// a part, next to the patch. Returns false if Newton's method does not find it there.
bool RefractingSurface::FindOnly(const CurvedPatch& patch, const PatchSlant& slant,
  const glm::dvec3& origin, const glm::dvec3& direction, SurfaceCrossing& crossing)
{
  const double cosine = glm::dot(slant.Facing, direction);
  // Written so that a NaN fails.
  if (!(slant.Largest * std::fabs(cosine) >= 1.0))
  {
    return false;
  }
  const double distance = glm::dot(slant.Facing, patch.Corner[0] - origin) / cosine;
  crossing.B = patch.ProjectToFacet(origin + distance * direction);
  // Scaled so that the parameter is about 1 or less.
  const double scale = std::max(patch.GetSize(), std::fabs(distance));
  double l = distance / scale;
  glm::dvec3 normal;
  if (!MeetPatch(patch, { origin, scale * direction }, crossing.B, l, normal))
  {
    return false;
  }
  const double outside = FindOutside(crossing.B).Least;
  crossing.Distance = l * scale;
  crossing.Side = cosine > 0.0 ? 1 : -1;
  return outside >= -PatchCrossings::Reach;
}

//------------------------------------------------------------------------------
// Takes the crossings with a patch that are nearer than those known, and reduces `most` to their
// distance.
void RefractingSurface::FindInPatch(std::int32_t facet, const glm::dvec3& origin,
  const HeightFrame& frame, int side, double least, double& most, SurfaceCrossing& nearest) const
{
  const CurvedPatch patch = this->Patches.GetPatch(facet);
  const auto take = [&](const glm::dvec2& b, double distance, int crossed)
  {
    if (!(distance >= least && distance <= most && (side == 0 || crossed == side)))
    {
      return;
    }
    // If two are at one distance, on a common edge, the smaller facet counts.
    if (nearest.Facet == CurvedPatches::NoFacet || distance < nearest.Distance ||
      facet < nearest.Facet)
    {
      nearest = { facet, b, distance, crossed };
    }
    most = distance;
  };
  SurfaceCrossing only;
  const PatchSlant& slant = this->Slants[static_cast<std::size_t>(facet)];
  if (std::isinf(slant.Largest) && glm::dot(slant.Facing, frame.Axis) == 0.0)
  {
    return; // a flat patch and a line that is parallel to it or lies in it: no point of it crosses
  }
  if (FindOnly(patch, slant, origin, frame.Axis, only))
  {
    if (FindOutside(only.B).Least >= -PatchCrossings::Border)
    {
      take(only.B, only.Distance, only.Side);
    }
    return;
  }
  const double start = frame.GetHeight(origin);
  PatchCrossings crossings(patch, frame);
  crossings.Find(frame.Project(origin), start + least, start + most);
  for (const PatchCrossing& crossing : crossings)
  {
    take(crossing.B, crossing.Height - start, crossing.Side);
  }
}

//------------------------------------------------------------------------------
bool RefractingSurface::IsOnSurface(const glm::dvec3& local) const
{
  const double slack = this->GetSlack(glm::length(local));
  bool touched = false;
  const TubeBounds place{ local - slack, local + slack, glm::dvec3(0.0), glm::dvec3(0.0) };
  this->VisitFacets(place,
    [this, &local, slack, &touched](std::int32_t facet, const TubeRange&)
    { touched = touched || IsOnPatch(this->Patches.GetPatch(facet), local, slack); });
  return touched;
}

}
