// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "StressCasters.h"

namespace meniscus::test
{

/** Results of some views. Results are added, except for the errors. */
struct StressTally
{
  std::int64_t Views = 0;
  std::int64_t Rays = 0;
  std::int64_t Steps = 0;
  /** Rays whose walk did not end on the boundary. */
  std::int64_t Lost = 0;
  /** Bent rays that were stopped in the mesh after their largest number of steps. */
  std::int64_t Stopped = 0;
  /** Those of them that have passed inverted cells, in which light would go backwards. */
  std::int64_t StoppedInFolds = 0;
  /**
   * Pixels with an error of more than FloatTolerance and more than the change of the exact result
   * when the ray moves by RoundingDistance, or drawn where there is nothing; silhouettes are not
   * included. With StressRule::Bounds, pixels out of bounds; bent rays with a
   * piece that is no path of light.
   */
  std::int64_t Wrong = 0;
  /**
   * Pixels with an error of more than FloatTolerance, but no more than rounding of vertices
   * explains.
   */
  std::int64_t Rounding = 0;
  /** Pixels with an error on silhouettes; more of them than a case allows count as wrong. */
  std::int64_t Silhouettes = 0;
  /** Largest error with respect to the reference, silhouettes and rounding not included. */
  double Largest = 0.0;
  /** Root mean square error over a view's covered pixels, of the worst view. */
  double Rms = 0.0;
  /** The first wrong view as text; empty if there is none. */
  std::string FirstWrong;

  void Add(const StressTally& other);
};

/** Casts a case in all of its views and checks the images by its rule. */
StressTally CheckCase(StressCaster& caster, const StressCase& stress);

} // namespace meniscus::test
