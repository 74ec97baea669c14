// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Curved/SightLanes.h"
#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Sight/SightEquation.h"
#include "Refraction/Sight/VirtualVertex.h"
#include "Refraction/Surface/CurveCrossings.h"
#include "Simd/InstructionSets.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A sight point and the facet whose patch it lies in. */
struct SightPlace
{
  std::int32_t Facet = CurvedPatches::NoFacet;
  SightRoot Root{};
};

/** Search for the image of a point from a place near its sight point. */
struct SightTrail
{
  enum class State
  {
    Open,
    Found,
    Lost,
    Answered ///< by other means
  };

  glm::dvec3 Point; ///< relative to the membrane's origin, as Target
  glm::dvec3 Target;
  SightPlace Place; ///< beforehand: a place from which the way to the target begins
  std::int32_t Hint = CurvedPatches::NoFacet; ///< a facet that may be nearer to the target
  State End = State::Open;
  int Patches = 0;                 ///< number of patches in which Newton's method has run
  VirtualVertex* Vertex = nullptr; ///< receives the vertex, in world coordinates, if it is found
};

/**
 * Newton's method across the patches of a membrane, each step from where the last one has left its
 * patch. Solving changes no state and may run on any number of threads at once.
 */
class SightFollower
{
public:
  /** All references must outlive this object. `origin` is the membrane's. */
  SightFollower(
    const CurvedPatches& patches, const Media& media, const glm::dvec3& origin, InstructionSet set)
    : Patches(patches)
    , Optics(media)
    , Origin(origin)
    , Set(set)
  {
  }

  /** The facet that is `step` numbers after another; NoFacet if there is none. Fetches its memory.
   */
  std::int32_t Expect(std::int32_t facet, std::int32_t step) const;

  /** Follows one trail to its end. */
  void Follow(SightTrail& trail) const;

  /** Follows several trails to their ends, side by side and with the same results. */
  void FollowAll(const std::vector<SightTrail*>& trails) const;

  /** The virtual vertex of a point, relative to the origin, with the sight point `at`. */
  VirtualVertex MakeVertex(
    const glm::dvec3& local, const CurvedPatch& patch, const SightPlace& at) const;

private:
  static bool MayGoOn(SightTrail& trail);
  void FollowInPatch(SightTrail& trail) const;
  bool IsNearer(std::int32_t facet, const SightTrail& trail) const;
  FacetWalk WalkToTarget(const SightTrail& trail) const;
  void WalkAll(SightTrail* const* trails, int count) const;
  void Resume(SightTrail& trail) const;
  void Load(const SightTrail& trail, int lane, SightLanes& lanes) const;
  void FollowBlock(SightTrail* const* trails, int count, SightLanes& lanes) const;
  VirtualVertex MakeVertex(const glm::dvec3& local, const SightPlace& at, const VirtualPlace& place,
    int orientation) const;

  const CurvedPatches& Patches;
  const Media& Optics;
  const glm::dvec3& Origin;
  InstructionSet Set;
};

}
