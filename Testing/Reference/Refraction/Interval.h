// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Interval arithmetic for the oracle of sight points. Bounds are rounded to nearest, not outwards:
 * the oracle adds the error of the membrane's mesh to every bound, which is larger by many orders
 * of magnitude.
 */
#pragma once

#include <algorithm>
#include <cmath>

namespace meniscus::reference
{

struct Interval
{
  double Low = 0.0;
  double High = 0.0;

  Interval() = default;
  Interval(double value) // NOLINT: a number is an interval
    : Low(value)
    , High(value)
  {
  }
  Interval(double from, double to)
    : Low(from)
    , High(to)
  {
  }

  bool HasZero() const { return this->Low <= 0.0 && this->High >= 0.0; }
  double GetMagnitude() const { return std::max(std::fabs(this->Low), std::fabs(this->High)); }
  double GetMignitude() const
  {
    return this->HasZero() ? 0.0 : std::min(std::fabs(this->Low), std::fabs(this->High));
  }
};

inline Interval operator+(const Interval& a, const Interval& b)
{
  return { a.Low + b.Low, a.High + b.High };
}

inline Interval operator-(const Interval& a, const Interval& b)
{
  return { a.Low - b.High, a.High - b.Low };
}

inline Interval operator-(const Interval& a)
{
  return { -a.High, -a.Low };
}

inline Interval operator*(double s, const Interval& a)
{
  return s >= 0.0 ? Interval(s * a.Low, s * a.High) : Interval(s * a.High, s * a.Low);
}

inline Interval operator*(const Interval& a, const Interval& b)
{
  const double p[4] = { a.Low * b.Low, a.Low * b.High, a.High * b.Low, a.High * b.High };
  return { std::min(std::min(p[0], p[1]), std::min(p[2], p[3])),
    std::max(std::max(p[0], p[1]), std::max(p[2], p[3])) };
}

/** `b` must be positive. */
inline Interval operator/(const Interval& a, const Interval& b)
{
  return a * Interval(1.0 / b.High, 1.0 / b.Low);
}

// The same functions for numbers, so that a formula can be written once for both types.

inline double Square(double a)
{
  return a * a;
}

inline Interval Square(const Interval& a)
{
  const double low = a.GetMignitude();
  const double high = a.GetMagnitude();
  return { low * low, high * high };
}

inline double Root(double a)
{
  return std::sqrt(a);
}

inline Interval Root(const Interval& a)
{
  return { std::sqrt(std::max(a.Low, 0.0)), std::sqrt(std::max(a.High, 0.0)) };
}

inline double Exponential(double a)
{
  return std::exp(a);
}

inline Interval Exponential(const Interval& a)
{
  return { std::exp(a.Low), std::exp(a.High) };
}

inline double Cosine(double a)
{
  return std::cos(a);
}

inline Interval Cosine(const Interval& a)
{
  constexpr double pi = 3.14159265358979323846;
  if (!(a.High - a.Low < 2.0 * pi))
  {
    return { -1.0, 1.0 };
  }
  // The extremes are at the multiples of pi inside the interval.
  const double first = std::ceil(a.Low / pi);
  const double last = std::floor(a.High / pi);
  const double ends[2] = { std::cos(a.Low), std::cos(a.High) };
  Interval result(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  for (double k = first; k <= last; k += 1.0)
  {
    (std::fmod(k, 2.0) == 0.0 ? result.High : result.Low) = std::fmod(k, 2.0) == 0.0 ? 1.0 : -1.0;
  }
  return result;
}

template <typename T>
T Sine(const T& a)
{
  constexpr double half = 1.57079632679489661923;
  return Cosine(a - T(half));
}

}
