// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Metamorphic relations: changes of a scene that must not change the result. No reference result is
 * needed, so scenes can be arbitrary.
 */
#pragma once

#include "MathBasics.h"

namespace meniscus::test
{

/** Outcome of comparing some pairs of results. The tally of several cases is the sum of theirs. */
struct RelationTally
{
  std::int64_t Scenes = 0;
  /** Number of pairs of results that were compared: images, meshes. */
  std::int64_t Comparisons = 0;
  /** Number of values that were compared: pixels, points, array values. */
  std::int64_t Values = 0;
  /**
   * Number of values beyond the plain tolerance, but within the change of the exact result under
   * the rounding for which the relation is derived.
   */
  std::int64_t Conditioned = 0;
  /** Number of values beyond their tolerance. */
  std::int64_t Wrong = 0;
  /** Number of scenes with a wrong value, or with a missing result. */
  std::int64_t Failures = 0;
  /**
   * Value with the largest ratio of deviation to tolerance; a tolerance below 0 means that there is
   * none yet.
   */
  double Deviation = 0.0;
  double Tolerance = -1.0;
  /** First failure in words; empty without one. */
  std::string FirstFailure;

  /** Adds one value. Returns true if it is within its tolerance; NaN is not. */
  bool Compare(double deviation, double tolerance);

  void Add(const RelationTally& other);
};

/** Runs one case. */
using RelationWork = std::function<RelationTally(int index)>;

struct Relation
{
  /** Name on the command line and in the report. */
  std::string Name;
  int Cases = 0;
  /**
   * Called in the process that runs its cases, before the first of them. All relations run in one
   * process until a case ends it, so that they can share objects that are slow to create (a
   * window).
   */
  std::function<RelationWork()> Start;
};

} // namespace meniscus::test
