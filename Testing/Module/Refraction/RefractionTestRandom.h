// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"

namespace meniscus::test
{

/** Random numbers that do not depend on the standard library. */
class Random
{
public:
  explicit Random(unsigned seed)
    : Engine(seed)
  {
  }
  double operator()(double low, double high)
  {
    return low + (high - low) * (this->Engine() / 4294967296.0);
  }
  glm::dvec3 Point(const glm::dvec3& low, const glm::dvec3& high)
  {
    const double x = (*this)(low.x, high.x);
    const double y = (*this)(low.y, high.y);
    return { x, y, (*this)(low.z, high.z) };
  }

private:
  std::mt19937 Engine;
};

}
