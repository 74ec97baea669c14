// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_StressCheck_h
#define meniscus_StressCheck_h

#include "StressCase.h"
#include "StressCasters.h"

#include <cstdint>
#include <string>

namespace meniscus
{
namespace test
{

/** What came of some views. Sums of several are sums of their parts but for the errors. */
struct StressTally
{
  std::int64_t Views = 0;
  std::int64_t Rays = 0;
  std::int64_t Steps = 0;
  /** Rays whose walk did not end on the boundary. */
  std::int64_t Lost = 0;
  /**
   * Pixels off by more than FloatTolerance and by more than moving the ray by RoundingDistance
   * changes the exact result, or drawn where nothing is; silhouettes apart. With
   * StressRule::Bounds pixels out of bounds.
   */
  std::int64_t Wrong = 0;
  /** Pixels off by more than FloatTolerance, but by no more than rounding of vertices explains. */
  std::int64_t Rounding = 0;
  /** Pixels off on silhouettes; more than a case allows count as wrong. */
  std::int64_t Silhouettes = 0;
  /** Against the reference, silhouettes and rounding apart. */
  double Largest = 0.0;
  /** Root mean square over a view's covered pixels, of the worst view. */
  double Rms = 0.0;
  /** The first wrong view in words; empty without one. */
  std::string FirstWrong;

  void add(const StressTally& other);
};

/** Casts a case in all of its views and judges the pictures by its rule. */
StressTally checkCase(StressCaster& caster, const StressCase& stress);

} // namespace test
} // namespace meniscus

#endif
