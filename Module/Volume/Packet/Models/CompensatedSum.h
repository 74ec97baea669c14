// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meniscus
{

/**
 * Compensated summation (W. Kahan), one sum per lane: long rays add thousands of small terms.
 */
template <class Simd>
class CompensatedSum
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  CompensatedSum()
    : Total(Simd::Splat(0.0f))
    , Rest(Simd::Splat(0.0f))
  {
  }

  /** Sets the sums of some lanes. */
  void Reset(Mask lanes, Float start)
  {
    this->Total = Simd::Select(lanes, start, this->Total);
    this->Rest = Simd::Select(lanes, Simd::Splat(0.0f), this->Rest);
  }
  void Add(Mask lanes, Float term)
  {
    const Float corrected = term - this->Rest;
    const Float sum = this->Total + corrected;
    this->Rest = Simd::Select(lanes, (sum - this->Total) - corrected, this->Rest);
    this->Total = Simd::Select(lanes, sum, this->Total);
  }
  const Float& Get() const { return this->Total; }
  void Set(Mask lanes, Float total) { this->Total = Simd::Select(lanes, total, this->Total); }

private:
  Float Total;
  /** Rounding error of the sum. */
  Float Rest;
};

}
