// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/SightRaySearch.h"

#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Surface/PatchCrossings.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace meniscus
{
namespace
{

/** Cone of the sight rays to a patch: a tube that starts at the eye. */
TubeBounds BoundSightRays(const CurvedPatch& patch, double bulge, const glm::dvec3& eye)
{
  const glm::dvec3 sights[3] = { patch.Corner[0] - eye, patch.Corner[1] - eye,
    patch.Corner[2] - eye };
  const DirectionBox sight =
    BoundDirections((sights[0] + sights[1] + sights[2]) / 3.0, sights, 3, bulge);
  return BoundRays(sight.Middle - sight.Half, sight.Middle + sight.Half, &eye, 1, 0.0);
}

}

//------------------------------------------------------------------------------
// A cone contains a sight ray entirely or not at all, so one place of the ray is tested. The
// farther the place is from the eye, the less the tree's rounding of coordinates turns the ray.
SightRaySearch::SightRaySearch(const CurvedMembraneSolver& geometry)
  : Geometry(geometry)
  , Tree(geometry.GetTree())
  , Distance(std::max(geometry.GetMembrane().GetRadius(), glm::length(geometry.GetMedia().Eye)))
  , Slack(geometry.GetMembrane().GetSlack(glm::length(geometry.GetMedia().Eye)))
{
  const CurvedPatches& patches = geometry.GetPatches();
  const std::size_t facets = geometry.GetMembrane().GetFacets().size();
  this->Bulges.reserve(facets);
  for (std::size_t i = 0; i < facets; ++i)
  {
    this->Bulges.push_back(BoundBulge(patches.GetPatch(static_cast<std::int32_t>(i))));
  }
  this->Tree.Refit(
    [this, &patches](std::int32_t facet)
    {
      return BoundSightRays(patches.GetPatch(facet), this->Bulges[static_cast<std::size_t>(facet)],
        this->Geometry.GetMedia().Eye);
    },
    SerialLoop);
}

//------------------------------------------------------------------------------
bool SightRaySearch::Find(
  const glm::dvec3& direction, const glm::dvec3& near, PatchPoint& at, std::int32_t& found) const
{
  const glm::dvec3& eye = this->Geometry.GetMedia().Eye;
  const glm::dvec3& origin = this->Geometry.GetMembrane().GetOrigin();
  const HeightFrame frame(direction);
  const glm::dvec2 place = frame.Project(eye);
  const double height = frame.GetHeight(eye);
  double least = std::numeric_limits<double>::infinity();
  this->Tree.Visit(eye + this->Distance * direction, 0.0,
    [&](std::int32_t facet)
    {
      constexpr std::int32_t all = std::numeric_limits<std::int32_t>::max();
      const CurvedPatch patch = this->Geometry.GetPatches().GetPatch(facet);
      if (!PassesNear({ frame.Project(patch.Corner[0]), frame.Project(patch.Corner[1]),
                        frame.Project(patch.Corner[2]) },
            place, this->Bulges[static_cast<std::size_t>(facet)] + this->Slack))
      {
        return all;
      }
      PatchCrossings crossings(patch, frame);
      crossings.Find(place, height, std::numeric_limits<double>::max());
      for (const PatchCrossing& crossing : crossings)
      {
        const glm::dvec3 position = eye + (crossing.Height - height) * direction + origin;
        const glm::dvec3 way = position - near;
        if (crossing.Height > height && glm::dot(crossing.Normal, direction) < 0.0 &&
          glm::dot(way, way) < least)
        {
          least = glm::dot(way, way);
          at = { position, glm::normalize(crossing.Normal) };
          found = facet;
        }
      }
      return all;
    });
  return least < std::numeric_limits<double>::infinity();
}

}
