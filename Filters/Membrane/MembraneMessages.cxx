// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/MembraneMessages.h"

#include "vtkObject.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
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
// Rays to the middles of facets, and to their places next to the eye's foot, where angles are
// smallest.
std::string DescribeReflection(const RefractionStack& stack)
{
  constexpr std::size_t mostFacets = 256;
  const std::vector<RefractionStack::Link>& links = stack.GetLinks();
  const RefractionStack::Link& first = links.front();
  const std::size_t count = first.Surface->GetMembrane().GetFacets().size();
  const std::size_t stride = (count + mostFacets - 1) / mostFacets;
  std::size_t last = 0; // number of interfaces before that of the reflection
  bool isReflected = false;
  StackPath path;
  for (std::size_t i = 0; i < count; i += stride)
  {
    const auto facet = static_cast<std::int32_t>(i);
    const glm::dvec2 foot = glm::max(
      first.Surface->GetPatches().GetPatch(facet).ProjectToFacet(stack.GetEye() - first.Shift),
      glm::dvec2(0.0));
    for (const glm::dvec2& place : { glm::dvec2(1.0 / 3.0), foot / std::max(1.0, foot.x + foot.y) })
    {
      path.Forget(links.size());
      const PathEnd end = stack.Trace({ facet, place }, links.size(), false, path);
      if (end == PathEnd::Passed)
      {
        return std::string();
      }
      if (end == PathEnd::Reflected)
      {
        isReflected = true;
        last = std::max(last, path.Count);
      }
    }
  }
  std::ostringstream text;
  if (isReflected)
  {
    const InterfacePassage& passage = links[last].Passage;
    text << "Everything is totally reflected: no sight ray passes interface " << links[last].Index
         << ", from the medium with the index " << passage.Before
         << " to the medium with the index " << passage.Behind << ". ";
  }
  return text.str();
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
