// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <vector>

namespace meniscus
{

/**
 * Directions of lines that are known to cross a surface of curved patches once at most: the surface
 * is a field of heights over a convex polygon, and all its normals are on the same side of the
 * line, so that the height of the line above the surface changes in one sense only.
 */
class SteepDirections
{
public:
  /** `normals` are bounds of the normals of each patch. */
  void Build(const Membrane& membrane, const CurvedPatches& patches,
    const std::vector<DirectionBox>& normals);

  bool Contains(const glm::dvec3& direction) const
  {
    return std::fabs(glm::dot(direction, this->Axis)) > this->LeastCosine;
  }

private:
  glm::dvec3 Axis{ 0.0 };   ///< mean of the normals
  double LeastCosine = 2.0; ///< above 1 if no direction is known
};

}
