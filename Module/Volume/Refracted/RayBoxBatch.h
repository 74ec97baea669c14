// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Tests of many rays with one box at once, compiled per instruction set; see LaneLoop.h. */
#ifndef meniscus_Volume_Refracted_RayBoxBatch_h
#define meniscus_Volume_Refracted_RayBoxBatch_h

#include "Simd/InstructionSets.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

/** Parts of rays in any directions. A ray's point at the depth t is Start + t * Direction. */
struct RayBoxBatch
{
  static constexpr int Size = 64;

  int Count = 0;
  double Start[3][Size];
  double Direction[3][Size];
  /** Reciprocals of the direction's components; of 1e-300 for smaller ones. */
  double Inverse[3][Size];
  /** Depths between which the ray is tested. */
  double First[Size];
  double Last[Size];
  /** Not 0 if the ray may meet the box. */
  std::int64_t Meets[Size];

  /** Adds a ray from `first` on, without an end. */
  void Add(const glm::dvec3& start, const glm::dvec3& direction, double first);
  glm::dvec3 GetStart(int i) const
  {
    return { this->Start[0][i], this->Start[1][i], this->Start[2][i] };
  }
  glm::dvec3 GetDirection(int i) const
  {
    return { this->Direction[0][i], this->Direction[1][i], this->Direction[2][i] };
  }
};

/**
 * Computes Meets. Returns true if any ray may meet the box; no ray that meets it is missed.
 * @pre GetInstructionSets() has the set
 */
bool MeetBox(const glm::dvec3& low, const glm::dvec3& high, InstructionSet set, RayBoxBatch& lanes);

}

#endif
