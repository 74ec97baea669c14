// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Private structures of PrimitiveMapper. */
#pragma once

#include "Refraction/Images/ObjectPrimitive.h"
#include "Refraction/Images/PrimitiveMapper.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

struct PrimitiveMapper::Corner : ClippedCorner<PrimitiveConstraints>
{
};

/** A primitive, the patch that it is mapped from, and the mesh that gets its images. */
struct PrimitiveMapper::Context : ObjectPrimitive
{
  ImageMesh* Images = nullptr;
  const CurvedPatch* Patch = nullptr;
  std::int32_t Facet = CurvedPatches::NoFacet;
  std::vector<char>* IsOnMembrane = nullptr; ///< marks points of `Images` on the membrane; null if
                                             ///< not needed
  PrimitiveMapper::Meetings* Meetings = nullptr; ///< those that are known in the sub-cell
  bool* IsPartInFront = nullptr; ///< becomes true if a part of the primitive is in front of the
                                 ///< membrane by more than the tolerance; null if not needed

  /** Component along the plane's normal of the ray to a mapped point; only its sign matters. */
  double GetSlope(const ImagePoint& point, const glm::dvec3& origin) const
  {
    return glm::dot(
      this->Normal, this->GetPoint(this->GetWeight(point)) - (point.Vertex.SightPoint - origin));
  }
};

}
