// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/TruePositions.h"

#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace meniscus
{
//------------------------------------------------------------------------------
TruePositions::TruePositions(const CurvedMembraneSolver& geometry, const SteepDirections& steep)
  : Geometry(geometry)
  , Steep(steep)
  , Search(geometry)
  , Eye(geometry.GetMedia().Eye + geometry.GetMembrane().GetOrigin())
{
}

//------------------------------------------------------------------------------
// Intersection with the membrane. A ray that is known to cross it once at most needs no search.
bool TruePositions::Meet(const glm::dvec3& direction, CrossingChain& chain, PatchPoint& at) const
{
  const bool isSteep = this->Steep.Contains(direction);
  const glm::dvec3& origin = this->Geometry.GetMembrane().GetOrigin();
  const CurvedPatches& patches = this->Geometry.GetPatches();
  if (isSteep && chain.Follow(patches, this->Geometry.GetMedia().Eye, direction, at) &&
    glm::dot(at.Normal, direction) < 0.0)
  {
    at.Position += origin;
    return true;
  }
  chain.Forget();
  std::int32_t facet = CurvedPatches::NoFacet;
  if (!this->Search.Find(direction, this->Eye, at, facet))
  {
    return false;
  }
  if (isSteep)
  {
    chain.Begin(patches, facet, at.Position - origin);
  }
  return true;
}

//------------------------------------------------------------------------------
TruePosition TruePositions::Find(
  const glm::dvec3& seen, CrossingChain& chain, SeenDepth depth) const
{
  const glm::dvec3 none(std::numeric_limits<double>::quiet_NaN());
  const glm::dvec3 sight = seen - this->Eye;
  const double distance = glm::length(sight);
  if (!std::isfinite(distance) || distance == 0.0)
  {
    return { seen, none, SeenState::NotFinite };
  }
  const glm::dvec3 direction = sight / distance;
  PatchPoint at;
  if (!this->Meet(direction, chain, at))
  {
    return { seen, none, SeenState::Unrefracted };
  }
  const double behind = glm::dot(seen - at.Position, direction);
  if (behind <= 0.0)
  {
    return { seen, none, SeenState::Unrefracted };
  }
  const Media& media = this->Geometry.GetMedia();
  const RefractionRay ray =
    ComputeRefractionRay(direction, at.Normal, media.Exterior / media.Interior);
  if (ray.Kind != RayKind::Refracted)
  {
    return { seen, at.Position, SeenState::TotallyReflected };
  }
  const double length =
    GetTrueLength(depth, GetSeenLength(depth, behind, media.Exterior), media.Interior);
  return { at.Position + length * ray.Direction, at.Position, SeenState::Refracted };
}

}
