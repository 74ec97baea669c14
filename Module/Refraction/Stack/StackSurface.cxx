// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackSurface.h"

#include "Refraction/Curved/PatchCrossings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace meniscus
{

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
  const double start = frame.GetHeight(origin);
  const double pad = this->GetSlack(glm::length(origin));
  const TubeBounds ray{ origin - pad, origin + pad, direction, direction };
  nearest.Facet = CurvedPatches::NoFacet;
  this->Tree.Visit(ray, most,
    [&](std::int32_t facet, const TubeRange&)
    {
      if (!this->MayCross(facet, frame, place))
      {
        return most;
      }
      const CurvedPatch patch = this->Patches.GetPatch(facet);
      PatchCrossings crossings(patch, frame);
      crossings.Find(place, start + least, start + most);
      if (!crossings.IsComplete())
      {
        ++this->Undecided;
      }
      for (const PatchCrossing& crossing : crossings)
      {
        const double distance = crossing.Height - start;
        if (distance >= least && distance <= most && (side == 0 || crossing.Side == side))
        {
          // If two are at one distance, on a common edge, the smaller facet counts.
          if (nearest.Facet == CurvedPatches::NoFacet || distance < nearest.Distance ||
            facet < nearest.Facet)
          {
            nearest = { facet, crossing.B, distance, crossing.Side };
          }
          most = distance;
        }
      }
      return most;
    });
  return nearest.Facet != CurvedPatches::NoFacet;
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
