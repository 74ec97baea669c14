// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/PatchTree.h"

#include "Refraction/Tubes/RefractedRayBounds.h"
#include "Volume/Refracted/PatchIntersector.h"

#include <glm/common.hpp>

namespace meniscus
{
//------------------------------------------------------------------------------
void PatchTree::Build(const Membrane& surface, const CurvedPatches& patches, const RangeLoop& loop)
{
  std::vector<AxisBox> boxes(surface.GetFacets().size());
  this->Patches.resize(boxes.size());
  loop(boxes.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end; ++f)
      {
        const auto facet = static_cast<std::int32_t>(f);
        const CurvedPatch patch = patches.GetPatch(facet);
        const auto& corner = patch.Corner;
        const glm::dvec3 reach(BoundBulge(patch) + PatchIntersector::Margin * patch.GetSize());
        boxes[f] = { glm::min(corner[0], glm::min(corner[1], corner[2])) - reach,
          glm::max(corner[0], glm::max(corner[1], corner[2])) + reach };
        const DirectionBox normals = BoundNormals(patch);
        const glm::dvec3 half = normals.Half + PatchIntersector::NormalMargin;
        this->Patches[f] = { boxes[f], { normals.Middle - half, normals.Middle + half } };
      }
    });
  this->Boxes.Build(boxes);
}

}
