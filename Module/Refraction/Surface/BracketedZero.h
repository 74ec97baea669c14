// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace meniscus
{

/**
 * Zero of a function on [0, 1] with the values `atStart` and `atEnd` at its ends, or the end with
 * the smaller value if both have one sign. Chandrupatla's method (Advances in Engineering Software
 * 28, 1997): inverse quadratic interpolation where the values at three samples are monotone enough
 * for it to land inside the bracket, otherwise bisection. `measure(s, value)` returns true if the
 * value is zero within its rounding.
 */
template <typename Measure>
double FindZero(double atStart, double atEnd, const Measure& measure)
{
  // Fraction of the interval to which the zero is bracketed. The function is known to some 1e-15 of
  // it.
  constexpr double bracket = 1e-14;
  // Bisection alone brackets a zero in 47 steps; at least every other step is a bisection.
  constexpr int steps = 100;
  struct Sample
  {
    double S;
    double Value;
  };
  Sample a{ 0.0, atStart };
  Sample b{ 1.0, atEnd };
  if (!(a.Value * b.Value < 0.0))
  {
    return std::fabs(a.Value) < std::fabs(b.Value) ? a.S : b.S;
  }
  double part = a.Value / (a.Value - b.Value);
  for (int i = 0; i < steps; ++i)
  {
    Sample next{ a.S + part * (b.S - a.S), 0.0 };
    if (measure(next.S, next.Value))
    {
      return next.S;
    }
    Sample c = a;
    if ((next.Value < 0.0) != (a.Value < 0.0))
    {
      c = b;
      b = a;
    }
    a = next;
    const double least = 0.5 * bracket / std::fabs(b.S - a.S);
    if (!(least < 0.5))
    {
      break;
    }
    const double xi = (a.S - b.S) / (c.S - b.S);
    const double phi = (a.Value - b.Value) / (c.Value - b.Value);
    part = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
    {
      part = a.Value / (b.Value - a.Value) * (c.Value / (b.Value - c.Value)) +
        (c.S - a.S) / (b.S - a.S) * (a.Value / (c.Value - a.Value)) *
          (b.Value / (c.Value - b.Value));
    }
    part = std::clamp(part, least, 1.0 - least);
  }
  return std::fabs(a.Value) < std::fabs(b.Value) ? a.S : b.S;
}

}
