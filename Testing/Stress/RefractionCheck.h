// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractionCase.h"

namespace meniscus::test
{

/** Results of some cases. Results are added, except for the error. */
struct RefractionTally
{
  std::int64_t Points = 0;
  /** Images of which the reference is certain. */
  std::int64_t Images = 0;
  /** Points at which the mesh's error, a caustic or a border leaves the number of images open. */
  std::int64_t Uncertain = 0;
  /** Points that the oracle has given up. */
  std::int64_t GivenUp = 0;
  /** Images that were not found. */
  std::int64_t Missed = 0;
  /** Reported images where there is none. */
  std::int64_t False = 0;
  /**
   * Images whose virtual vertex, depth, reflectance or orientation does not belong to the sight
   * point, and first images that are not among all images.
   */
  std::int64_t Wrong = 0;
  /** Points without an answer, and membranes or eyes that were rejected. */
  std::int64_t Failed = 0;
  /** Largest distance between a sight point and the true one, in facets. */
  double Largest = 0.0;
  /** Sight rays through several interfaces that missed a later one, or were totally reflected. */
  std::int64_t RaysMissed = 0;
  std::int64_t RaysReflected = 0;
  /** Points whose search for all images the solver itself counts as undecided. */
  std::int64_t Undecided = 0;
  /** Virtual points that were led back, and the largest error, relative to the scene. */
  std::int64_t RoundTrips = 0;
  double LargestRoundTrip = 0.0;
  /** First failure as text; empty if there is none. */
  std::string First;

  /** Counts a fault at point `i`, and describes it if it is the first one. */
  template <typename Value>
  void Count(std::int64_t RefractionTally::*fault, int i, const char* text, const Value& value)
  {
    ++(this->*fault);
    if (this->First.empty())
    {
      std::ostringstream line;
      line.precision(10);
      line << "point " << i << ": " << text << ", " << value;
      this->First = line.str();
    }
  }

  void Add(const RefractionTally& other);
  bool IsGood() const
  {
    return this->Missed == 0 && this->False == 0 && this->Wrong == 0 && this->Failed == 0;
  }
};

/** Solves a case and compares every answer with the case's reference. */
RefractionTally CheckCase(const RefractionCase& test);

} // namespace meniscus::test
