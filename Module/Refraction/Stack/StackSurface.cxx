// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackSurface.h"

#include "Refraction/Curved/CurveCrossings.h"
#include "Refraction/Curved/PatchCrossings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

// Newton's method converges quadratically: the remaining error is of the order of the square of
// the last step, 1e-14 of a facet.
constexpr double LastStep = 1e-7;

// Slant of most rays. The cheap bound of the largest slant is enough if it is above; another value
// changes the time only.
constexpr double CommonSlant = 4.0;

}

//------------------------------------------------------------------------------
MembraneStatus StackSurface::SetMembrane(const MembraneInput& input, const RangeLoop& loop)
{
  const MembraneStatus status = this->Surface.Build(input);
  this->Patches.Build(this->Surface, loop);
  const std::size_t count = this->Surface.GetFacets().size();
  this->Bounds.resize(count);
  const double slack = this->GetSlack(0.0);
  loop(count,
    [this, slack](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const CurvedPatch patch = this->Patches.GetPatch(static_cast<std::int32_t>(i));
        PatchBounds& bounds = this->Bounds[i];
        bounds.Bulge = BoundBulge(patch) + slack;
        bounds.Normals = BoundNormals(patch);
        bounds.LargestSlant = PatchCrossings::BoundLargestSlant(patch);
        if (bounds.LargestSlant < CommonSlant)
        {
          bounds.LargestSlant = PatchCrossings(patch, HeightFrame()).GetLargestSlant();
        }
        const glm::dvec3 winding = glm::normalize(
          glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]));
        const glm::dvec3 normal = patch.Normal[0] + patch.Normal[1] + patch.Normal[2];
        bounds.Facing = glm::dot(winding, normal) < 0.0 ? -winding : winding;
        bounds.Box = AxisBox();
        for (const glm::dvec3& corner : patch.Corner)
        {
          bounds.Box.Add({ corner - bounds.Bulge, corner + bounds.Bulge });
        }
      }
    });
  std::vector<AxisBox> boxes;
  std::vector<DirectionBox> normals;
  boxes.reserve(count);
  normals.reserve(count);
  AxisBox whole;
  for (const PatchBounds& bounds : this->Bounds)
  {
    boxes.push_back(bounds.Box);
    normals.push_back(bounds.Normals);
    whole.Add(bounds.Box);
  }
  const glm::dvec3 sides = whole.High - whole.Low;
  this->Width = std::max({ 0.0, sides.x, sides.y, sides.z });
  this->Tree.Build(boxes);
  this->Steep.Build(this->Surface, this->Patches, normals);
  return status;
}

//------------------------------------------------------------------------------
// With the normals, q changes its sign too, so that its product with the normal does not.
CurvedPatch StackSurface::GetPatch(std::int32_t facet, bool flipped) const
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
double StackSurface::GetSlack(double distance) const
{
  return this->Surface.GetSlack(distance);
}

//------------------------------------------------------------------------------
bool StackSurface::MayCross(
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
bool StackSurface::FindCrossing(const glm::dvec3& origin, const glm::dvec3& direction, int side,
  double least, double most, SurfaceCrossing& nearest) const
{
  const HeightFrame frame(direction);
  const glm::dvec2 place = frame.Project(origin);
  const double pad = this->GetSlack(glm::length(origin));
  const TubeBounds ray{ origin - pad, origin + pad, direction, direction };
  nearest.Facet = CurvedPatches::NoFacet;
  this->Tree.Visit(ray, most,
    [&](std::int32_t facet, const TubeRange&)
    {
      const PatchBounds& bounds = this->GetBounds(facet);
      const double cosine = glm::dot(bounds.Facing, direction);
      // Written so that a NaN fails.
      const bool isOnce = bounds.LargestSlant * std::fabs(cosine) >= 1.0;
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
bool StackSurface::FindOnly(const CurvedPatch& patch, const PatchBounds& bounds,
  const glm::dvec3& origin, const glm::dvec3& direction, SurfaceCrossing& crossing)
{
  const double cosine = glm::dot(bounds.Facing, direction);
  // Written so that a NaN fails.
  if (!(bounds.LargestSlant * std::fabs(cosine) >= 1.0))
  {
    return false;
  }
  const double distance = glm::dot(bounds.Facing, patch.Corner[0] - origin) / cosine;
  crossing.B = patch.ProjectToFacet(origin + distance * direction);
  // Scaled so that the parameter is about 1 or less.
  const double scale = std::max(patch.GetSize(), std::fabs(distance));
  double l = distance / scale;
  glm::dvec3 normal;
  if (!MeetPatch(patch, { origin, scale * direction }, LastStep, crossing.B, l, normal))
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
void StackSurface::FindInPatch(std::int32_t facet, const glm::dvec3& origin,
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
  if (FindOnly(patch, this->GetBounds(facet), origin, frame.Axis, only))
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
  if (!crossings.IsComplete())
  {
    ++this->Undecided;
  }
  for (const PatchCrossing& crossing : crossings)
  {
    take(crossing.B, crossing.Height - start, crossing.Side);
  }
}

//------------------------------------------------------------------------------
bool StackSurface::IsOnSurface(const glm::dvec3& local) const
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
