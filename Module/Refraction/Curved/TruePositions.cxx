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
TruePositions::TruePositions(const CurvedMembraneSolver& geometry)
  : Geometry(geometry)
  , Search(geometry)
  , Eye(geometry.GetMedia().Eye + geometry.GetMembrane().GetOrigin())
{
}

//------------------------------------------------------------------------------
TruePosition TruePositions::Find(const glm::dvec3& seen) const
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
  if (!this->Search.Find(direction, this->Eye, at))
  {
    return { seen, none, SeenState::Unrefracted };
  }
  const double apparent = glm::dot(seen - at.Position, direction);
  if (apparent <= 0.0)
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
  const double depth = apparent * media.Interior / media.Exterior;
  return { at.Position + depth * ray.Direction, at.Position, SeenState::Refracted };
}

}
