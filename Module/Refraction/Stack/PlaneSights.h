// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Stack/ParallelPlanes.h"
#include "Refraction/Stack/PlaneLanes.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/** Lanes of places that are drawn somewhere; vectors are relative to the eye, by component. */
struct DrawnLanes : PlaneLanes
{
  double Place[3][Most];
  double Drawn[3][Most];
  double IsClose[Most]; ///< 1 if the place is drawn along its sight ray, otherwise 0
};

/**
 * Tests for many places behind parallel planes whether they are drawn along their sight rays. A
 * test may have several places, all of which must be.
 */
class PlaneSights
{
public:
  /**
   * `planes` must outlive this object. `tolerance` is an angle in radians at the eye. The
   * number of a test that fails is appended to `failed`, perhaps several times.
   */
  PlaneSights(const ParallelPlanes& planes, double tolerance, std::vector<std::size_t>& failed)
    : Planes(planes)
    , Tolerance(tolerance)
    , Failed(failed)
  {
    this->Lanes.Count = 0;
  }

  /**
   * Adds a place behind `count` planes, at least one, to test `number`. `place` and `drawn` are
   * vectors from the eye.
   */
  void Add(std::size_t number, std::size_t count, const glm::dvec3& place, const glm::dvec3& drawn);

  /** Completes the tests of the places that have been added. */
  void Finish();

private:
  const ParallelPlanes& Planes;
  double Tolerance;
  std::vector<std::size_t>& Failed;
  std::size_t InFront = 0; ///< number of planes in front of the places in the lanes
  std::size_t Numbers[PlaneLanes::Most];
  DrawnLanes Lanes;
};

}
