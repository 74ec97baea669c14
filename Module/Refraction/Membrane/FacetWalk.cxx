// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/FacetWalk.h"

#include "Common/Prefetch.h"
#include "Refraction/Membrane/CrossProduct.h"
#include "Refraction/Membrane/CurvedPatches.h"

#include <glm/common.hpp>

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
// Coordinates are read from plain arrays, since an index that varies is a branch in GLM's vectors.
FacetWalk::FacetWalk(const CurvedPatches& patches, std::int32_t facet, const glm::dvec3& target,
  const glm::dvec3& normal, int steps)
  : Patches(&patches)
  , Facet(facet)
  , Steps(steps)
  , IsRead(true)
{
  const glm::dvec3 size = glm::abs(normal);
  this->Along = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  this->First = (this->Along + 1) % 3;
  this->Second = (this->Along + 2) % 3;
  const double* n = &normal.x;
  const double* at = &target.x;
  const double inverse = 1.0 / n[this->Along];
  this->Slope = glm::dvec2(n[this->First] * inverse, n[this->Second] * inverse);
  this->Height = at[this->Along];
  this->Origin = glm::dvec2(at[this->First], at[this->Second]);
  const CurvedPatches::Patch& patch = patches.Patches[static_cast<std::size_t>(facet)];
  for (int k = 0; k < 3; ++k)
  {
    this->Vertex[k] = patch.Vertex[k];
    this->Corner[k] = this->Project(patch.Vertex[k]);
  }
}

//------------------------------------------------------------------------------
glm::dvec2 FacetWalk::Project(std::int32_t vertex) const
{
  const double* p = &this->Patches->Surface->GetPositions()[static_cast<std::size_t>(vertex)].x;
  const double along = p[this->Along] - this->Height;
  return { p[this->First] - this->Origin.x - this->Slope.x * along,
    p[this->Second] - this->Origin.y - this->Slope.y * along };
}

//------------------------------------------------------------------------------
bool FacetWalk::Advance()
{
  if (!this->IsRead)
  {
    this->ReadFacet();
    return true;
  }
  if (this->NewCorner >= 0)
  {
    this->Corner[this->NewCorner] = this->Project(this->Vertex[this->NewCorner]);
  }
  const int exit = this->Steps > 0 ? this->FindExit() : -1;
  if (exit < 0)
  {
    return false;
  }
  const auto& patches = this->Patches->Patches;
  const std::int32_t next = patches[static_cast<std::size_t>(this->Facet)].Neighbour[exit];
  if (next == CurvedPatches::NoFacet)
  {
    return false;
  }
  Prefetch(&patches[static_cast<std::size_t>(next)]);
  this->Facet = next;
  --this->Steps;
  this->NewCorner = exit;
  this->IsRead = false;
  return true;
}

//------------------------------------------------------------------------------
// Two corners are those of the facet before; NewCorner is the number of the one that is not.
void FacetWalk::ReadFacet()
{
  const int first = (this->NewCorner + 1) % 3;
  const int second = (this->NewCorner + 2) % 3;
  const std::int32_t vertex[2] = { this->Vertex[first], this->Vertex[second] };
  const glm::dvec2 shared[2] = { this->Corner[first], this->Corner[second] };
  const CurvedPatches::Patch& patch = this->Patches->Patches[static_cast<std::size_t>(this->Facet)];
  for (int k = 0; k < 3; ++k)
  {
    const std::int32_t at = patch.Vertex[k];
    this->Vertex[k] = at;
    this->Corner[k] = at == vertex[0] ? shared[0] : shared[1];
    this->NewCorner = at == vertex[0] || at == vertex[1] ? this->NewCorner : k;
  }
  const auto added = static_cast<std::size_t>(this->Vertex[this->NewCorner]);
  Prefetch(&this->Patches->Surface->GetPositions()[added]);
  this->IsRead = true;
}

//------------------------------------------------------------------------------
// Corner opposite the edge beyond which the target is farthest; -1 if it is in the facet.
int FacetWalk::FindExit() const
{
  const glm::dvec2(&c)[3] = this->Corner;
  const double area[3] = { Cross(c[1], c[2]), Cross(c[2], c[0]), Cross(c[0], c[1]) };
  const double sign = area[0] + area[1] + area[2] < 0.0 ? -1.0 : 1.0;
  const double first = sign * area[0];
  const double second = sign * area[1];
  const double third = sign * area[2];
  const bool isSecond = second < first;
  const double least = isSecond ? second : first;
  const int exit = third < least ? 2 : static_cast<int>(isSecond);
  return std::min(least, third) >= 0.0 ? -1 : exit;
}

}
