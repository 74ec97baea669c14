// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackPassage.h"

#include "Refraction/Stack/StackShot.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

// Parts have at least 2^-26 of the facet's size, PatchCrossings::Border: a later surface may be
// much smaller than a facet of the first one. Where intervals exclude all but a few parts of a
// level, a level takes a few rays.
constexpr int DeepestLevel = 26;

// Rays to try before no further level begins. A list without a passage, most of whose parts cannot
// be excluded, takes this many, or a few per facet.
constexpr std::size_t MostTries = 1 << 12;

// Patches of the second surface that rays are aimed at.
constexpr std::size_t MostAims = 16;

}

//------------------------------------------------------------------------------
bool StackPassage::Find()
{
  if (this->TryMiddles() || this->TryFeet() || this->TryAims())
  {
    return true;
  }
  const std::size_t count =
    this->Stack.GetLinks().front().Surface->GetMembrane().GetFacets().size();
  std::vector<Part> parts;
  parts.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    parts.push_back(
      { static_cast<std::int32_t>(i), { glm::dvec2(0.0), { 1.0, 0.0 }, { 0.0, 1.0 } } });
  }
  // Every facet is divided once.
  for (int level = 0; level < DeepestLevel && (level == 0 || this->Tries < MostTries); ++level)
  {
    if (this->TryParts(parts))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Patches are tried with strides that get smaller, so that the first few are far apart.
bool StackPassage::TryMiddles()
{
  const std::size_t count =
    this->Stack.GetLinks().front().Surface->GetMembrane().GetFacets().size();
  std::size_t top = 1;
  while (top < count)
  {
    top *= 2;
  }
  std::size_t begin = 0;
  for (std::size_t stride = top; stride > 0; stride /= 2)
  {
    for (std::size_t i = begin; i < count; i += 2 * stride)
    {
      if (this->IsPassedAt(static_cast<std::int32_t>(i), glm::dvec2(1.0 / 3.0)))
      {
        return true;
      }
    }
    begin = stride / 2; // odd multiples of the next stride are new
  }
  return false;
}

//------------------------------------------------------------------------------
// Rays to the places of facets next to the eye's foot: where large facets are seen at a slant,
// rays may be totally reflected nearly everywhere.
bool StackPassage::TryFeet()
{
  const RefractionStack::Link& first = this->Stack.GetLinks().front();
  const auto count = static_cast<std::int32_t>(first.Surface->GetMembrane().GetFacets().size());
  for (std::int32_t i = 0; i < count; ++i)
  {
    const glm::dvec2 foot =
      first.Surface->GetPatches().GetPatch(i).ProjectToFacet(this->Stack.GetEye() - first.Shift);
    const glm::dvec2 inside = glm::max(foot, glm::dvec2(0.0));
    if (this->IsPassedAt(i, inside / std::max(1.0, inside.x + inside.y)))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Rays to the middles of patches of the second surface, with strides over all of them. The second
// surface may be much smaller than a facet of the first one, of which the parts that show it are
// few.
bool StackPassage::TryAims()
{
  const std::vector<RefractionStack::Link>& links = this->Stack.GetLinks();
  if (links.size() < 2)
  {
    return false;
  }
  const CurvedPatches& patches = links[1].Surface->GetPatches();
  const std::size_t count = links[1].Surface->GetMembrane().GetFacets().size();
  const std::size_t stride = (count + MostAims - 1) / MostAims;
  for (std::size_t i = 0; i < count; i += stride)
  {
    const PatchPoint aim =
      patches.GetPatch(static_cast<std::int32_t>(i)).Evaluate(glm::dvec2(1.0 / 3.0));
    const StackTarget target{ aim.Position + links[1].Shift, 1 };
    const glm::dvec3 straight = target.Point - this->Stack.GetEye();
    const double distance = glm::length(straight);
    SurfaceCrossing crossing;
    this->Path.Forget(links.size());
    if (distance > 0.0 &&
      this->Stack.FindNext(0, this->Stack.GetEye(), straight / distance, crossing, distance) &&
      Shoot(this->Stack, target, { crossing.Facet, crossing.B }, ShotSteps, this->Path) ==
        ShotEnd::Converged &&
      this->IsPassedAt(this->Path.Points[0].Place.Facet, this->Path.Points[0].Place.B))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Replaces parts that may pass by their quarters. Rays to their own middles have been tried.
bool StackPassage::TryParts(std::vector<Part>& parts)
{
  std::vector<Part> quarters;
  for (const Part& part : parts)
  {
    if (!MayMeet(this->Stack, part.Facet, part.Corners, this->Stack.GetLinks().size() - 1))
    {
      continue;
    }
    PatchTriangle middles;
    for (std::size_t k = 0; k < 3; ++k)
    {
      middles[k] = 0.5 * (part.Corners[(k + 1) % 3] + part.Corners[(k + 2) % 3]);
    }
    quarters.push_back({ part.Facet, middles });
    for (std::size_t k = 0; k < 3; ++k)
    {
      const PatchTriangle corner{ part.Corners[k], middles[(k + 2) % 3], middles[(k + 1) % 3] };
      if (this->IsPassedAt(part.Facet, (corner[0] + corner[1] + corner[2]) / 3.0))
      {
        return true;
      }
      quarters.push_back({ part.Facet, corner });
    }
  }
  parts.swap(quarters);
  return false;
}

//------------------------------------------------------------------------------
bool StackPassage::IsPassedAt(std::int32_t facet, const glm::dvec2& b)
{
  ++this->Tries;
  const std::vector<RefractionStack::Link>& links = this->Stack.GetLinks();
  const RefractionStack::Link& link = links.front();
  const glm::dvec3 target = link.Surface->GetPatches().GetPatch(facet).Evaluate(b).Position;
  const glm::dvec3 eye = this->Stack.GetEye() - link.Shift;
  const double distance = glm::length(target - eye);
  SurfaceCrossing crossing;
  if (!(distance > 0.0) ||
    !link.Surface->FindCrossing(
      eye, (target - eye) / distance, 0, 0.0, std::numeric_limits<double>::max(), crossing) ||
    crossing.Side != (link.Passage.FromFront ? -1 : 1))
  {
    return false;
  }
  this->Path.Forget(links.size());
  const PathEnd end =
    this->Stack.Trace({ crossing.Facet, crossing.B }, links.size(), false, this->Path);
  return end == PathEnd::Passed ||
    (end == PathEnd::Reflected && this->Path.Count + 1 == links.size());
}

}
