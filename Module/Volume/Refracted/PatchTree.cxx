// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/PatchTree.h"

#include "Common/MedianSplit.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace meniscus
{
namespace
{

/**
 * Distance, in units of a facet's longest edge, by which its box is larger than the patch. An
 * intersection lies outside of its facet by up to 1e-8 in barycentric coordinates, which is 3e-8
 * edges at most; the rest exceeds the rounding of coordinates up to 1e8 edges from the origin.
 */
constexpr double BoxMargin = 1e-7;

}

struct PatchTree::Item
{
  glm::dvec3 Lower;
  glm::dvec3 Upper;
  /** Number of the facet. */
  std::int32_t Index;
};

//------------------------------------------------------------------------------
void PatchTree::Build(const Membrane& surface, const CurvedPatches& patches, const RangeLoop& loop)
{
  std::vector<Item> items(surface.GetFacets().size());
  loop(items.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end; ++f)
      {
        const auto facet = static_cast<std::int32_t>(f);
        const CurvedPatch patch = patches.GetPatch(facet);
        const auto& corner = patch.Corner;
        const double edge = std::max({ glm::distance(corner[0], corner[1]),
          glm::distance(corner[1], corner[2]), glm::distance(corner[2], corner[0]) });
        const glm::dvec3 reach(BoundBulge(patch) + BoxMargin * edge);
        items[f] = { glm::min(corner[0], glm::min(corner[1], corner[2])) - reach,
          glm::max(corner[0], glm::max(corner[1], corner[2])) + reach, facet };
      }
    });
  this->Nodes.clear();
  if (!items.empty())
  {
    this->Nodes.reserve(2 * items.size() - 1);
    this->BuildSubtree(items, 0, items.size());
  }
}

//------------------------------------------------------------------------------
void PatchTree::BuildSubtree(std::vector<Item>& items, std::size_t first, std::size_t last)
{
  const std::size_t node = this->Nodes.size();
  this->Nodes.push_back({ items[first].Lower, items[first].Upper, 0, -1 });
  for (std::size_t i = first + 1; i < last; ++i)
  {
    this->Nodes[node].Low = glm::min(this->Nodes[node].Low, items[i].Lower);
    this->Nodes[node].High = glm::max(this->Nodes[node].High, items[i].Upper);
  }
  if (last - first == 1)
  {
    this->Nodes[node].Facet = items[first].Index;
  }
  else
  {
    const std::size_t middle = SplitAtMedian(items, first, last);
    this->BuildSubtree(items, first, middle);
    this->BuildSubtree(items, middle, last);
  }
  this->Nodes[node].Skip = static_cast<std::int32_t>(this->Nodes.size());
}

}
