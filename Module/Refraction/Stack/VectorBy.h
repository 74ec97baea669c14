// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Derivatives of numbers and vectors by two parameters. Both derivatives are computed at once, in
 * the two lanes of a vector register, by the vector types of GCC and clang.
 */
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

/** Derivatives of a number by the first and by the second parameter. */
using NumberBy = double __attribute__((vector_size(16)));

inline NumberBy MakeNumberBy(const glm::dvec2& by)
{
  return NumberBy{ by.x, by.y };
}

/** Larger modulus of the two derivatives. */
inline double GetLargest(const NumberBy& by)
{
  return std::max(std::fabs(by[0]), std::fabs(by[1]));
}

/** Larger modulus of two coordinates. */
inline double GetLargest(const glm::dvec2& v)
{
  return std::max(std::fabs(v.x), std::fabs(v.y));
}

/** Change of a number with a change of the parameters. */
inline double GetChange(const NumberBy& by, const glm::dvec2& move)
{
  const NumberBy parts = by * MakeNumberBy(move);
  return parts[0] + parts[1];
}

/** Derivatives of a vector. */
struct VectorBy
{
  NumberBy X;
  NumberBy Y;
  NumberBy Z;

  /** Derivative by one of the parameters. */
  glm::dvec3 operator[](int k) const { return { this->X[k], this->Y[k], this->Z[k] }; }
};

inline VectorBy MakeVectorBy(const glm::dvec3 by[2])
{
  return { NumberBy{ by[0].x, by[1].x }, NumberBy{ by[0].y, by[1].y },
    NumberBy{ by[0].z, by[1].z } };
}

inline VectorBy operator+(const VectorBy& a, const VectorBy& b)
{
  return { a.X + b.X, a.Y + b.Y, a.Z + b.Z };
}

inline VectorBy operator-(const VectorBy& a, const VectorBy& b)
{
  return { a.X - b.X, a.Y - b.Y, a.Z - b.Z };
}

inline VectorBy operator*(double a, const VectorBy& b)
{
  return { a * b.X, a * b.Y, a * b.Z };
}

/** Derivatives of a constant vector times a number. */
inline VectorBy operator*(const glm::dvec3& a, const NumberBy& b)
{
  return { a.x * b, a.y * b, a.z * b };
}

/** Derivatives of the scalar product with a constant vector. */
inline NumberBy Dot(const glm::dvec3& a, const VectorBy& b)
{
  return a.x * b.X + a.y * b.Y + a.z * b.Z;
}

inline glm::dvec3 GetChange(const VectorBy& by, const glm::dvec2& move)
{
  return { GetChange(by.X, move), GetChange(by.Y, move), GetChange(by.Z, move) };
}

}
