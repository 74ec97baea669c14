// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"

namespace meniscus::test
{

/** Random numbers that are the same with every standard library. */
class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : State(seed)
  {
  }
  /** SplitMix64 (Steele, Lea and Flood 2014). */
  std::uint64_t Bits()
  {
    std::uint64_t z = (this->State += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double Uniform(double low = 0.0, double high = 1.0)
  {
    return low + (high - low) * static_cast<double>(this->Bits() >> 11) * 0x1p-53;
  }
  int Below(int n) { return static_cast<int>(this->Bits() % static_cast<std::uint64_t>(n)); }

  glm::dvec3 GetDirection()
  {
    // Rejection from the cube: avoids library functions whose last digit may differ.
    for (;;)
    {
      const double x = this->Uniform(-1.0, 1.0);
      const double y = this->Uniform(-1.0, 1.0);
      const glm::dvec3 v(x, y, this->Uniform(-1.0, 1.0));
      const double length = glm::length(v);
      if (length > 0.1 && length <= 1.0)
      {
        return v / length;
      }
    }
  }

private:
  std::uint64_t State;
};

} // namespace meniscus::test
