// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatches.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

/**
 * Crossing of a surface of curved patches with the last of a chain of neighbouring rays. The
 * crossing of the next ray is found from it without a search. Positions are relative to the
 * membrane's origin.
 */
class CrossingChain
{
public:
  /** Forgets the last ray. The last bits of the next crossings would depend on it. */
  void Forget() { this->Facet = CurvedPatches::NoFacet; }

  /** Records the facet of a ray's crossing and its position. */
  void Begin(const CurvedPatches& patches, std::int32_t facet, const glm::dvec3& position);

  /**
   * Finds a crossing with the ray from `origin` along the unit vector `direction` by Newton's
   * method, from the facet of the last ray on across patches. It need not be the nearest one if the
   * ray may cross the surface more than once (SteepDirections).
   * @param at the crossing, with the unit normal of the surface; undefined without a crossing.
   * @return false if there was no last ray, or none was found near it
   */
  bool Follow(const CurvedPatches& patches, const glm::dvec3& origin, const glm::dvec3& direction,
    PatchPoint& at);

private:
  std::int32_t Facet = CurvedPatches::NoFacet;
  CurvedPatch Patch{};
  glm::dvec3 Position{ 0.0 };
  /** Distance in the patch from the place where the ray meets the flat facet. */
  glm::dvec2 Offset{ 0.0 };
};

}
