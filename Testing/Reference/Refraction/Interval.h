// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Interval arithmetic for the oracle of sight points. Bounds are rounded to nearest, not outwards:
 * the oracle adds the error of the membrane's mesh to every bound, which is many orders above it.
 */
#ifndef meniscus_Interval_h
#define meniscus_Interval_h

#include <algorithm>
#include <cmath>

namespace meniscus::reference
{

struct Interval
{
  double low = 0.0;
  double high = 0.0;

  Interval() = default;
  Interval(double value) // NOLINT: a number is an interval
    : low(value)
    , high(value)
  {
  }
  Interval(double from, double to)
    : low(from)
    , high(to)
  {
  }

  bool HasZero() const { return this->low <= 0.0 && this->high >= 0.0; }
  double GetMagnitude() const { return std::max(std::fabs(this->low), std::fabs(this->high)); }
  double GetMignitude() const
  {
    return this->HasZero() ? 0.0 : std::min(std::fabs(this->low), std::fabs(this->high));
  }
};

inline Interval operator+(const Interval& a, const Interval& b)
{
  return { a.low + b.low, a.high + b.high };
}

inline Interval operator-(const Interval& a, const Interval& b)
{
  return { a.low - b.high, a.high - b.low };
}

inline Interval operator-(const Interval& a)
{
  return { -a.high, -a.low };
}

inline Interval operator*(double s, const Interval& a)
{
  return s >= 0.0 ? Interval(s * a.low, s * a.high) : Interval(s * a.high, s * a.low);
}

inline Interval operator*(const Interval& a, const Interval& b)
{
  const double p[4] = { a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high };
  return { std::min(std::min(p[0], p[1]), std::min(p[2], p[3])),
    std::max(std::max(p[0], p[1]), std::max(p[2], p[3])) };
}

/// `b` must be positive.
inline Interval operator/(const Interval& a, const Interval& b)
{
  return a * Interval(1.0 / b.high, 1.0 / b.low);
}

// The same functions for numbers, so that a formula can be written once for both.

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
  return { std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0)) };
}

inline double Exponential(double a)
{
  return std::exp(a);
}

inline Interval Exponential(const Interval& a)
{
  return { std::exp(a.low), std::exp(a.high) };
}

inline double Cosine(double a)
{
  return std::cos(a);
}

inline Interval Cosine(const Interval& a)
{
  constexpr double pi = 3.14159265358979323846;
  if (!(a.high - a.low < 2.0 * pi))
  {
    return { -1.0, 1.0 };
  }
  // Multiples of pi inside are the extremes.
  const double first = std::ceil(a.low / pi);
  const double last = std::floor(a.high / pi);
  const double ends[2] = { std::cos(a.low), std::cos(a.high) };
  Interval result(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  for (double k = first; k <= last; k += 1.0)
  {
    (std::fmod(k, 2.0) == 0.0 ? result.high : result.low) = std::fmod(k, 2.0) == 0.0 ? 1.0 : -1.0;
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

#endif
