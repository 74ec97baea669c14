// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

namespace meniscus
{

/**
 * Packets of 4 lanes for any processor, in the vector types of GCC and Clang, which become the
 * processor's vector instructions where it has them. The other instruction sets offer the same
 * names with intrinsics; the templates of the ray caster use no others.
 *
 * Float, Int (32 bits) and Mask hold one value per lane. Comparisons with NaN are false; Min and
 * Max return their second argument if either is NaN.
 */
struct SimdPortable
{
  static constexpr int Width = 4;
  using FloatVector = float __attribute__((vector_size(16)));
  using IntVector = std::int32_t __attribute__((vector_size(16)));

  /** All bits of a lane are set, or none. */
  struct Mask
  {
    IntVector Bits;
    friend Mask operator&(Mask a, Mask b) { return { a.Bits & b.Bits }; }
    friend Mask operator|(Mask a, Mask b) { return { a.Bits | b.Bits }; }
  };

  struct Float
  {
    FloatVector V;
    friend Float operator+(Float a, Float b) { return { a.V + b.V }; }
    friend Float operator-(Float a, Float b) { return { a.V - b.V }; }
    friend Float operator*(Float a, Float b) { return { a.V * b.V }; }
    friend Float operator/(Float a, Float b) { return { a.V / b.V }; }
    friend Mask operator<(Float a, Float b) { return { IntVector(a.V < b.V) }; }
    friend Mask operator>(Float a, Float b) { return { IntVector(a.V > b.V) }; }
  };

  struct Int
  {
    IntVector V;
    // Unsigned: sums of signed integers must not overflow.
    friend Int operator+(Int a, Int b) { return { IntVector(Unsigned(a.V) + Unsigned(b.V)) }; }
    friend Int operator-(Int a, Int b) { return { IntVector(Unsigned(a.V) - Unsigned(b.V)) }; }
    friend Mask operator<(Int a, Int b) { return { IntVector(a.V < b.V) }; }
    friend Mask operator>(Int a, Int b) { return { IntVector(a.V > b.V) }; }

  private:
    using Unsigned = std::uint32_t __attribute__((vector_size(16)));
  };

  static Float Load(const float* from)
  {
    Float result;
    std::memcpy(&result.V, from, sizeof(result.V));
    return result;
  }
  static Int Load(const std::int32_t* from)
  {
    Int result;
    std::memcpy(&result.V, from, sizeof(result.V));
    return result;
  }
  static void Store(float* to, Float x) { std::memcpy(to, &x.V, sizeof(x.V)); }
  static void Store(std::int32_t* to, Int x) { std::memcpy(to, &x.V, sizeof(x.V)); }
  static Float Splat(float value) { return { FloatVector{ value, value, value, value } }; }
  static Int Splat(std::int32_t value) { return { IntVector{ value, value, value, value } }; }

  /** a * b + c, with one rounding or two. */
  static Float Fma(Float a, Float b, Float c) { return a * b + c; }
  /** a - b * c, with one rounding. */
  static Float SubtractProduct(Float a, Float b, Float c)
  {
    return FloatOf([&](int i) { return std::fma(-b.V[i], c.V[i], a.V[i]); });
  }
  /**
   * a * d - b * c by Kahan's method. Unless a product under- or overflows, the error is at most 2
   * units in the last place (C.-P. Jeannerod, N. Louvet and J.-M. Muller, "Further analysis of
   * Kahan's algorithm for the accurate computation of 2x2 determinants", 2013), so the sign is
   * exact, and the result is 0 only if the two products are equal.
   */
  static Float CrossProduct(Float a, Float b, Float c, Float d)
  {
    const Float bc = b * c;
    return FloatOf([&](int i) { return std::fma(a.V[i], d.V[i], -bc.V[i]); }) +
      SubtractProduct(bc, b, c);
  }
  static Float Min(Float a, Float b) { return Select(a < b, a, b); }
  static Float Max(Float a, Float b) { return Select(a > b, a, b); }
  static Float Abs(Float a) { return { FloatVector(IntVector(a.V) & Splat(INT32_MAX).V) }; }
  static Float Sqrt(Float a)
  {
    return FloatOf([&](int i) { return std::sqrt(a.V[i]); });
  }

  static Float Select(Mask mask, Float yes, Float no)
  {
    return { FloatVector(Choose(mask.Bits, IntVector(yes.V), IntVector(no.V))) };
  }
  static Int Select(Mask mask, Int yes, Int no) { return { Choose(mask.Bits, yes.V, no.V) }; }
  /** 1 where the mask is set, otherwise 0. */
  static Int One(Mask mask) { return { mask.Bits & Splat(1).V }; }
  /** a and not b. */
  static Mask AndNot(Mask a, Mask b) { return { a.Bits & ~b.Bits }; }
  static Mask Not(Mask a) { return { ~a.Bits }; }
  /** Bit mask in which bit i is lane i. */
  static unsigned int Bits(Mask mask)
  {
    unsigned int bits = 0;
    for (int i = 0; i < Width; ++i)
    {
      bits |= static_cast<unsigned int>(mask.Bits[i]) & 1u << i;
    }
    return bits;
  }
  static Mask FromBits(unsigned int bits)
  {
    const IntVector lane = { 1, 2, 4, 8 };
    return { IntVector((Splat(static_cast<std::int32_t>(bits)).V & lane) == lane) };
  }

  /** a + 1 and a - 1 in the lanes where the mask is set. */
  static Int Increment(Mask mask, Int a) { return a - Int{ mask.Bits }; }
  static Int Decrement(Mask mask, Int a) { return a + Int{ mask.Bits }; }
  static Int And(Int a, Int b) { return { a.V & b.V }; }
  static Float ToFloat(Int a) { return { __builtin_convertvector(a.V, FloatVector) }; }
  /** The nearest integer, even if there are two. Any result if it has more than 32 bits. */
  static Int ToInt(Float a)
  {
    return IntOf([&](int i) { return static_cast<std::int32_t>(std::llrint(a.V[i])); });
  }
  /** The bits of a, which must not be negative, shifted right by b, 0 to 31. */
  static Int ShiftRight(Int a, Int b) { return { a.V >> b.V }; }
  /** table[index], for a table of 32 entries and an index below 24. */
  static Int LookupOf24(const std::int32_t (&table)[32], Int index)
  {
    return IntOf([&](int i) { return table[index.V[i]]; });
  }

  /** Loads, for each lane, the four floats at `from + Stride * index`. */
  template <int Stride>
  static void GatherQuads(const float* from, Int index, Float& x, Float& y, Float& z, Float& w)
  {
    const auto column = [&](int k)
    { return FloatOf([&](int i) { return from[std::int64_t{ Stride } * index.V[i] + k]; }); };
    x = column(0);
    y = column(1);
    z = column(2);
    w = column(3);
  }
  /** Loads, for each lane, the three floats at `from + 3 * index`. */
  static void GatherTriples(const float* from, Int index, Float& x, Float& y, Float& z)
  {
    const auto column = [&](int k)
    { return FloatOf([&](int i) { return from[std::int64_t{ 3 } * index.V[i] + k]; }); };
    x = column(0);
    y = column(1);
    z = column(2);
  }
  /**
   * Loads, for each lane, the two numbers at `pairs + 2 * index`, and asks for the memory of the
   * pair that the first of them is the index of, if it is not negative.
   */
  static void FollowPairs(const std::int32_t* pairs, Int index, Int& first, Int& second)
  {
    const auto column = [&](int k)
    { return IntOf([&](int i) { return pairs[std::int64_t{ 2 } * index.V[i] + k]; }); };
    first = column(0);
    second = column(1);
  }
  /** scalars[cellFace / 4] for each lane. */
  static Float GatherCellScalars(const float* scalars, Int cellFace)
  {
    return Lookup<1>(scalars, { cellFace.V >> 2 });
  }
  /** table[index], for a table of `Blocks` (1 or 2) times LookupBlock entries. */
  static constexpr int LookupBlock = 8;
  template <int Blocks>
  static Float Lookup(const float* table, Int index)
  {
    return FloatOf([&](int i) { return table[index.V[i]]; });
  }
  /** The same bits as an integer. */
  static Int AsInt(Float a) { return { IntVector(a.V) }; }

private:
  /** The values of a function of the lane. */
  template <typename Function>
  static Float FloatOf(const Function& value)
  {
    return { FloatVector{ value(0), value(1), value(2), value(3) } };
  }
  template <typename Function>
  static Int IntOf(const Function& value)
  {
    return { IntVector{ value(0), value(1), value(2), value(3) } };
  }
  static IntVector Choose(IntVector mask, IntVector yes, IntVector no)
  {
    return (yes & mask) | (no & ~mask);
  }
};

}
