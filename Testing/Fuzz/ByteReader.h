// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace meniscus::test
{

/**
 * Reads values from the bytes of a fuzzer, from the front. Behind the last byte all values are
 * zero, so that every sequence of bytes is an input.
 */
class ByteReader
{
public:
  ByteReader(const std::uint8_t* bytes, std::size_t size)
    : Next(bytes)
    , Left(size)
  {
  }

  /** A value of any bits. */
  template <typename T>
  T Read()
  {
    T value{};
    const std::size_t size = std::min(sizeof(T), this->Left);
    if (size > 0)
    {
      std::memcpy(&value, this->Next, size);
      this->Next += size;
      this->Left -= size;
    }
    return value;
  }

  /** An integer in [0, count), from one byte; count is at most 256. */
  int Below(int count) { return this->Read<std::uint8_t>() % count; }
  bool Flag() { return this->Below(2) == 1; }

  /**
   * A number of any kind. The first byte selects it: half of them are multiples of 1/16 in [-4, 4),
   * for which equal, collinear and coplanar points are likely; a quarter are finer, and the others
   * are of any size, not finite ones included.
   */
  double Number()
  {
    const int kind = this->Below(256);
    if (kind < 128)
    {
      return (kind - 64) / 16.0;
    }
    if (kind < 192)
    {
      return this->Read<std::int16_t>() / 4096.0;
    }
    if (kind < 224)
    {
      return this->Read<float>();
    }
    return kind < 240 ? this->Read<double>() : SpecialNumber(kind - 240);
  }

  /** As Number(), but zero instead of numbers that are not finite. */
  double FiniteNumber()
  {
    const double number = this->Number();
    return std::isfinite(number) ? number : 0.0;
  }

  /** A number in [0, 1], in steps of 1/255. */
  double Share() { return this->Below(256) / 255.0; }

  glm::dvec3 Vector()
  {
    const double x = this->Number();
    const double y = this->Number();
    return { x, y, this->Number() };
  }
  glm::dvec3 FiniteVector()
  {
    const double x = this->FiniteNumber();
    const double y = this->FiniteNumber();
    return { x, y, this->FiniteNumber() };
  }
  glm::dvec3 Color()
  {
    const double r = this->Share();
    const double g = this->Share();
    return { r, g, this->Share() };
  }

private:
  static double SpecialNumber(int index)
  {
    using Limits = std::numeric_limits<double>;
    static const std::array<double, 16> numbers = { Limits::quiet_NaN(), Limits::infinity(),
      -Limits::infinity(), Limits::max(), -Limits::max(), Limits::min(), Limits::denorm_min(), -0.0,
      1e30, -1e30, 1e-30, double{ std::numeric_limits<float>::max() }, 1e154,
      1.0 + Limits::epsilon(), 9007199254740993.0, 1e9 + 0.5 };
    return numbers[static_cast<std::size_t>(index)];
  }

  const std::uint8_t* Next;
  std::size_t Left;
};

}
