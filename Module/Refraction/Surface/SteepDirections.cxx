// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Surface/SteepDirections.h"

#include "Refraction/Membrane/HeightField.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace meniscus
{

//------------------------------------------------------------------------------
// The normals of patches and facets are within some angle of their mean. Those of the curved
// surface itself follow from its tangents, which are at right angles to the normals at the corners
// and deviate from the facet in between by no more than these do: they are within twice the angle.
void SteepDirections::Build(
  const Membrane& membrane, const CurvedPatches& patches, const std::vector<DirectionBox>& normals)
{
  this->LeastCosine = 2.0;
  glm::dvec3 sum(0.0);
  for (const DirectionBox& box : normals)
  {
    sum += box.Middle;
  }
  if (!(glm::length(sum) > 0.0))
  {
    return;
  }
  this->Axis = glm::normalize(sum);
  double least = 1.0;
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    const DirectionBox& box = normals[i];
    const CurvedPatch patch = patches.GetPatch(static_cast<std::int32_t>(i));
    const glm::dvec3 winding =
      glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]);
    const double side = std::copysign(1.0, glm::dot(winding, box.Middle));
    least = std::min({ least, side * glm::dot(glm::normalize(winding), this->Axis),
      glm::dot(box.Middle, this->Axis) - glm::dot(box.Half, glm::abs(this->Axis)) });
  }
  // sin 2t for cos t = least; no line is certain from 45 degrees on.
  if (least * least > 0.5 && least > 0.0 &&
    IsConvexField(membrane, patches, HeightFrame(this->Axis)))
  {
    this->LeastCosine = 2.0 * least * std::sqrt(1.0 - least * least);
  }
}

}
