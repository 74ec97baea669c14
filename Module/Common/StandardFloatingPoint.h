// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfenv>

namespace meniscus
{

/**
 * While an object of this class exists, its thread calculates as IEEE 754 does by default: numbers
 * are rounded to the nearest, results below the smallest normal number are kept, and no operation
 * raises a signal. Afterwards the thread's mode is as it was before.
 *
 * Host programs change this mode: Open VKL and OSPRay flush small numbers to zero on the thread
 * that starts them, as does a library linked with `-ffast-math` on the thread that loads it, and
 * solvers such as OpenFOAM raise signals for numbers that are not finite. Exact tests, and loops
 * that end at the next larger number, rely on the default.
 */
class StandardFloatingPoint
{
public:
  StandardFloatingPoint()
  {
    std::fegetenv(&this->Before);
    std::fesetenv(FE_DFL_ENV);
  }
  ~StandardFloatingPoint() { std::fesetenv(&this->Before); }
  StandardFloatingPoint(const StandardFloatingPoint&) = delete;
  void operator=(const StandardFloatingPoint&) = delete;

private:
  std::fenv_t Before;
};

}
