// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_PatchTree_h
#define meniscus_Volume_Refracted_PatchTree_h

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Tubes/BoxTree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Tree of the boxes around the curved patches of a surface, and boxes around their unit normals. It
 * does not depend on the view.
 */
class PatchTree
{
public:
  void Build(const Membrane& surface, const CurvedPatches& patches, const RangeLoop& loop);

  /** Items are facets; coordinates are relative to the membrane's origin. */
  const BoxTree& GetBoxes() const { return this->Boxes; }
  /** Bounds of the intersections of rays with a patch. */
  struct PatchBox
  {
    AxisBox Places;
    /** Unit normals. */
    AxisBox Normals;
  };
  const PatchBox& GetPatch(std::int32_t facet) const
  {
    return this->Patches[static_cast<std::size_t>(facet)];
  }
  std::int64_t GetBytes() const
  {
    return this->Boxes.GetBytes() +
      static_cast<std::int64_t>(this->Patches.capacity() * sizeof(PatchBox));
  }

private:
  BoxTree Boxes;
  std::vector<PatchBox> Patches;
};

}

#endif
