// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

class CurvedPatches;

/**
 * The straight way from a facet to a target, projected along a normal, for CurvedPatches::Walk.
 * Each part of a step ends with a request for the memory of the next one, so several walks that
 * take turns do not wait for each other's memory.
 *
 * Corners are projected to a plane of two coordinate axes in which the target is the origin.
 */
class FacetWalk
{
public:
  FacetWalk() = default;
  FacetWalk(const CurvedPatches& patches, std::int32_t facet, const glm::dvec3& target,
    const glm::dvec3& normal, int steps);

  /** Does a part of a step. Returns false if the way has ended. */
  bool Advance();
  /** Goes to the end of the way, and returns its facet. */
  std::int32_t Finish()
  {
    while (this->Advance())
    {
    }
    return this->Facet;
  }
  /** The facet that the way has come to. */
  std::int32_t GetFacet() const { return this->Facet; }

private:
  glm::dvec2 Project(std::int32_t vertex) const;
  void ReadFacet();
  int FindExit() const;

  const CurvedPatches* Patches = nullptr;
  std::int32_t Facet = 0;
  int Steps = 0;
  /** The axis along which corners are projected, and the two others. */
  int Along = 0;
  int First = 0;
  int Second = 0;
  double Height = 0.0; ///< coordinate of the target along the axis
  glm::dvec2 Origin{ 0.0 };
  glm::dvec2 Slope{ 0.0 };
  /** Corners of the facet; until it is read, corners of the facet before. */
  std::int32_t Vertex[3] = {};
  glm::dvec2 Corner[3] = {};
  bool IsRead = false;
  int NewCorner = -1; ///< corner that has yet to be projected
};

}
