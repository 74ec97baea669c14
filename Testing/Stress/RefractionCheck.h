// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_RefractionCheck_h
#define meniscus_RefractionCheck_h

#include "RefractionCase.h"

#include <cstdint>
#include <string>

namespace meniscus
{
namespace test
{

/** What came of some cases. Sums of several are sums of their parts but for the error. */
struct RefractionTally
{
  std::int64_t Points = 0;
  /** Images that the truth is certain of. */
  std::int64_t Images = 0;
  /** Points where the mesh's error, a caustic or a border leaves open how many images there are. */
  std::int64_t Uncertain = 0;
  /** Points that the oracle gave up. */
  std::int64_t GivenUp = 0;
  /** Images that were not found. */
  std::int64_t Missed = 0;
  /** Images where there is none. */
  std::int64_t False = 0;
  /**
   * Images whose virtual vertex, depth, reflectance or orientation is not that of the sight point,
   * and first images that are none of all.
   */
  std::int64_t Wrong = 0;
  /** Points without an answer, and membranes or eyes that were refused. */
  std::int64_t Failed = 0;
  /** Distance between a sight point and the true one, in facets. */
  double Largest = 0.0;
  /** The first fault in words; empty without one. */
  std::string First;

  void add(const RefractionTally& other);
  bool isGood() const
  {
    return this->Missed == 0 && this->False == 0 && this->Wrong == 0 && this->Failed == 0;
  }
};

/** Solves a case and judges every answer by the case's truth. */
RefractionTally checkCase(const RefractionCase& test);

} // namespace test
} // namespace meniscus

#endif
