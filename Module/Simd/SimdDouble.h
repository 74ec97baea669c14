// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace meniscus
{

/**
 * A packet of one lane in double precision, for optical models along rays that are not walked in
 * packets: sums of many short segments keep their precision. It has the operations of
 * SimdPortable.h, see there, that the model of composite blending needs.
 */
struct SimdDouble
{
  static constexpr int Width = 1;

  struct Mask
  {
    bool Bit;
    friend Mask operator&(Mask a, Mask b) { return { a.Bit && b.Bit }; }
    friend Mask operator|(Mask a, Mask b) { return { a.Bit || b.Bit }; }
  };

  struct Float
  {
    double V;
    friend Float operator+(Float a, Float b) { return { a.V + b.V }; }
    friend Float operator-(Float a, Float b) { return { a.V - b.V }; }
    friend Float operator*(Float a, Float b) { return { a.V * b.V }; }
    friend Float operator/(Float a, Float b) { return { a.V / b.V }; }
    friend Mask operator<(Float a, Float b) { return { a.V < b.V }; }
    friend Mask operator>(Float a, Float b) { return { a.V > b.V }; }
  };

  struct Int
  {
    std::int32_t V;
  };

  static Int Load(const std::int32_t* from) { return { *from }; }
  static void Store(float* to, Float x) { *to = static_cast<float>(x.V); }
  static void Store(std::int32_t* to, Int x) { *to = x.V; }
  static Float Splat(double value) { return { value }; }
  static Int Splat(std::int32_t value) { return { value }; }

  static Float Fma(Float a, Float b, Float c) { return { a.V * b.V + c.V }; }
  static Float Min(Float a, Float b) { return a.V < b.V ? a : b; }
  static Float Max(Float a, Float b) { return a.V > b.V ? a : b; }
  static Float Abs(Float a) { return { std::fabs(a.V) }; }
  static Float Sqrt(Float a) { return { std::sqrt(a.V) }; }

  static Float Select(Mask mask, Float yes, Float no) { return mask.Bit ? yes : no; }
  static Mask AndNot(Mask a, Mask b) { return { a.Bit && !b.Bit }; }
  static unsigned int Bits(Mask mask) { return mask.Bit ? 1u : 0u; }
  static Mask FromBits(unsigned int bits) { return { bits != 0 }; }
  static Int Increment(Mask mask, Int a) { return { a.V + (mask.Bit ? 1 : 0) }; }
  static Int Decrement(Mask mask, Int a) { return { a.V - (mask.Bit ? 1 : 0) }; }

  template <int Stride>
  static void GatherQuads(const float* from, Int index, Float& x, Float& y, Float& z, Float& w)
  {
    const float* const row = from + std::int64_t{ Stride } * index.V;
    x = { row[0] };
    y = { row[1] };
    z = { row[2] };
    w = { row[3] };
  }
  static constexpr int LookupBlock = 8;
  template <int Blocks>
  static Float Lookup(const float* table, Int index)
  {
    return { table[index.V] };
  }
};

}
