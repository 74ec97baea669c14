// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_StackedInterface_h
#define meniscus_Volume_Refracted_StackedInterface_h

#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/Membrane.h"
#include "Volume/Refracted/PatchTree.h"

namespace meniscus
{

/** A refracting surface in a list of them. All objects must outlive the users of the list. */
struct StackedInterface
{
  const Membrane* Surface = nullptr;
  const CurvedPatches* Patches = nullptr;
  const PatchTree* Tree = nullptr;
  /**
   * Indices of refraction on the side that the surface's normals point to, and on the other side;
   * they differ.
   */
  double Exterior = 1.0;
  double Interior = 1.0;
};

}

#endif
