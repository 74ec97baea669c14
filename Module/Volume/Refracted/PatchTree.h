// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_PatchTree_h
#define meniscus_Volume_Refracted_PatchTree_h

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Tubes/BoxTree.h"

#include <cstdint>

namespace meniscus
{

/** Tree of the boxes around the curved patches of a surface. It does not depend on the view. */
class PatchTree
{
public:
  void Build(const Membrane& surface, const CurvedPatches& patches, const RangeLoop& loop);

  /** Items are facets; coordinates are relative to the membrane's origin. */
  const BoxTree& GetBoxes() const { return this->Boxes; }
  std::int64_t GetBytes() const { return this->Boxes.GetBytes(); }

private:
  BoxTree Boxes;
};

}

#endif
