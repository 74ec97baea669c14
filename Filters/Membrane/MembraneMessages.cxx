// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/MembraneMessages.h"

#include "vtkObject.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <sstream>

namespace meniscus
{

//------------------------------------------------------------------------------
void Report(vtkObject* owner, const SceneMessages& messages)
{
  if (!messages.Error.empty())
  {
    vtkErrorWithObjectMacro(owner, << messages.Error << "; the output is empty.");
  }
  if (!messages.Warning.empty())
  {
    vtkWarningWithObjectMacro(owner, << messages.Warning);
  }
}

//------------------------------------------------------------------------------
std::string DescribeNoImage(
  const Membrane& surface, const glm::dvec3& eye, double side, double before, double behind)
{
  bool isSeen = false;
  bool isReflected = true;
  for (const Membrane::Facet& facet : surface.GetFacets())
  {
    for (const std::int32_t vertex : facet)
    {
      const auto i = static_cast<std::size_t>(vertex);
      const glm::dvec3 sight = eye - surface.GetPositions()[i];
      const double cosine = side * glm::dot(sight, surface.GetNormals()[i]) / glm::length(sight);
      if (cosine > 0.0)
      {
        isSeen = true;
        isReflected = isReflected && before * std::sqrt(1.0 - cosine * cosine) > behind;
      }
    }
  }
  if (isSeen && isReflected)
  {
    std::ostringstream text;
    text << "Everything is totally reflected: the eye sees each point of the membrane at more than "
            "the critical angle, "
         << glm::degrees(std::asin(behind / before))
         << " degrees from the normal, from the medium with the index " << before
         << " to the medium with the index " << behind << ".";
    return text.str();
  }
  return "Is the eye on the side that the membrane's normals point to, and are geometry (port 0) "
         "and membrane (port 1) at the right ports?";
}

//------------------------------------------------------------------------------
std::string DescribeBadEye(EyeStatus status, const glm::dvec3& eye)
{
  std::ostringstream text;
  text << "The eye (" << eye.x << ", " << eye.y << ", " << eye.z << ") "
       << (status == EyeStatus::OnTheMembrane ? "lies on the membrane" : "is not finite");
  return text.str();
}

}
