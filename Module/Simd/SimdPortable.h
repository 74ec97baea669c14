// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Simd_SimdPortable_h
#define meniscus_Simd_SimdPortable_h

#include <cmath>
#include <cstdint>
#include <cstring>

namespace meniscus
{

constexpr int PortableWidth = 4;

template <typename T>
struct PortableLanes
{
  T Of[PortableWidth];
};

/** Applies a function of lane values to each lane. */
template <typename Result, typename Function, typename... Arguments>
inline PortableLanes<Result> EachLane(const Function& function, const Arguments&... arguments)
{
  PortableLanes<Result> result;
  for (int i = 0; i < PortableWidth; ++i)
  {
    result.Of[i] = function(arguments.Of[i]...);
  }
  return result;
}

template <typename T>
inline PortableLanes<T> operator+(const PortableLanes<T>& a, const PortableLanes<T>& b)
{
  return EachLane<T>([](T x, T y) { return x + y; }, a, b);
}
template <typename T>
inline PortableLanes<T> operator-(const PortableLanes<T>& a, const PortableLanes<T>& b)
{
  return EachLane<T>([](T x, T y) { return x - y; }, a, b);
}
template <typename T>
inline PortableLanes<T> operator*(const PortableLanes<T>& a, const PortableLanes<T>& b)
{
  return EachLane<T>([](T x, T y) { return x * y; }, a, b);
}
template <typename T>
inline PortableLanes<T> operator/(const PortableLanes<T>& a, const PortableLanes<T>& b)
{
  return EachLane<T>([](T x, T y) { return x / y; }, a, b);
}
template <typename T>
inline PortableLanes<bool> operator<(const PortableLanes<T>& a, const PortableLanes<T>& b)
{
  return EachLane<bool>([](T x, T y) { return x < y; }, a, b);
}
template <typename T>
inline PortableLanes<bool> operator>(const PortableLanes<T>& a, const PortableLanes<T>& b)
{
  return b < a;
}
inline PortableLanes<bool> operator&(const PortableLanes<bool>& a, const PortableLanes<bool>& b)
{
  return EachLane<bool>([](bool x, bool y) { return x && y; }, a, b);
}
inline PortableLanes<bool> operator|(const PortableLanes<bool>& a, const PortableLanes<bool>& b)
{
  return EachLane<bool>([](bool x, bool y) { return x || y; }, a, b);
}

/**
 * Packets of 4 lanes in plain C++, for any processor. The other instruction sets offer the same
 * names with intrinsics; the templates of the ray caster use no others.
 *
 * Float, Int (32 bits) and Mask hold one value per lane. Comparisons with NaN are false; Min and
 * Max return their second argument if either is NaN.
 */
struct SimdPortable
{
  static constexpr int Width = PortableWidth;
  using Float = PortableLanes<float>;
  using Int = PortableLanes<std::int32_t>;
  using Mask = PortableLanes<bool>;

  template <typename T>
  static PortableLanes<T> Load(const T* from)
  {
    PortableLanes<T> result;
    std::memcpy(result.Of, from, sizeof(result.Of));
    return result;
  }
  template <typename T>
  static void Store(T* to, const PortableLanes<T>& x)
  {
    std::memcpy(to, x.Of, sizeof(x.Of));
  }
  template <typename T>
  static PortableLanes<T> Splat(T value)
  {
    return EachLane<T>([value](T) { return value; }, PortableLanes<T>());
  }

  /** a * b + c, with one rounding or two. */
  template <typename T>
  static PortableLanes<T> Fma(
    const PortableLanes<T>& a, const PortableLanes<T>& b, const PortableLanes<T>& c)
  {
    return a * b + c;
  }
  /** a - b * c, with one rounding. */
  static Float SubtractProduct(const Float& a, const Float& b, const Float& c)
  {
    return EachLane<float>([](float x, float y, float z) { return std::fma(-y, z, x); }, a, b, c);
  }
  /**
   * a * d - b * c by Kahan's method. Unless a product under- or overflows, the error is at most 2
   * units in the last place (C.-P. Jeannerod, N. Louvet and J.-M. Muller, "Further analysis of
   * Kahan's algorithm for the accurate computation of 2x2 determinants", 2013), so the sign is
   * exact, and the result is 0 only if the two products are equal.
   */
  static Float CrossProduct(const Float& a, const Float& b, const Float& c, const Float& d)
  {
    const Float bc = b * c;
    const Float roundOff = SubtractProduct(bc, b, c);
    return EachLane<float>([](float x, float y, float product, float rest)
      { return std::fma(x, y, -product) + rest; },
      a, d, bc, roundOff);
  }
  static Float Min(const Float& a, const Float& b)
  {
    return EachLane<float>([](float x, float y) { return x < y ? x : y; }, a, b);
  }
  static Float Max(const Float& a, const Float& b)
  {
    return EachLane<float>([](float x, float y) { return x > y ? x : y; }, a, b);
  }
  static Float Abs(const Float& a)
  {
    return EachLane<float>([](float x) { return std::fabs(x); }, a);
  }
  static Float Sqrt(const Float& a)
  {
    return EachLane<float>([](float x) { return std::sqrt(x); }, a);
  }

  template <typename T>
  static PortableLanes<T> Select(
    const Mask& mask, const PortableLanes<T>& yes, const PortableLanes<T>& no)
  {
    return EachLane<T>([](bool m, T x, T y) { return m ? x : y; }, mask, yes, no);
  }
  /** 1 where the mask is set, otherwise 0. */
  static Int One(const Mask& mask)
  {
    return EachLane<std::int32_t>([](bool m) { return m ? 1 : 0; }, mask);
  }
  /** a and not b. */
  static Mask AndNot(const Mask& a, const Mask& b)
  {
    return EachLane<bool>([](bool x, bool y) { return x && !y; }, a, b);
  }
  static Mask Not(const Mask& a)
  {
    return EachLane<bool>([](bool x) { return !x; }, a);
  }
  /** Bit mask in which bit i is lane i. */
  static unsigned int Bits(const Mask& mask)
  {
    unsigned int bits = 0;
    for (int i = 0; i < Width; ++i)
    {
      bits |= (mask.Of[i] ? 1u : 0u) << i;
    }
    return bits;
  }
  static Mask FromBits(unsigned int bits)
  {
    Mask mask;
    for (int i = 0; i < Width; ++i)
    {
      mask.Of[i] = (bits >> i & 1u) != 0;
    }
    return mask;
  }

  /** a + 1 and a - 1 in the lanes where the mask is set. */
  static Int Increment(const Mask& mask, const Int& a) { return a + One(mask); }
  static Int Decrement(const Mask& mask, const Int& a) { return a - One(mask); }
  static Int And(const Int& a, const Int& b)
  {
    return EachLane<std::int32_t>([](std::int32_t x, std::int32_t y) { return x & y; }, a, b);
  }
  static Float ToFloat(const Int& a)
  {
    return EachLane<float>([](std::int32_t x) { return static_cast<float>(x); }, a);
  }
  /** The nearest integer, even if there are two. Any result if it has more than 32 bits. */
  static Int ToInt(const Float& a)
  {
    return EachLane<std::int32_t>(
      [](float x) { return static_cast<std::int32_t>(std::llrint(x)); }, a);
  }
  /** The bits of a, which must not be negative, shifted right by b, 0 to 31. */
  static Int ShiftRight(const Int& a, const Int& b)
  {
    return EachLane<std::int32_t>([](std::int32_t x, std::int32_t y) { return x >> y; }, a, b);
  }
  /** table[index], for a table of 32 entries and an index below 24. */
  static Int LookupOf24(const std::int32_t (&table)[32], const Int& index)
  {
    return EachLane<std::int32_t>([&table](std::int32_t i) { return table[i]; }, index);
  }
  /** from[index], for an index in the 32 bits of an unsigned integer. */
  static Int LoadFrom(const std::int32_t* from, const Int& index)
  {
    return EachLane<std::int32_t>(
      [from](std::int32_t i) { return from[static_cast<std::uint32_t>(i)]; }, index);
  }

  /** Loads, for each lane, the four floats at `from + Stride * index`. */
  template <int Stride>
  static void GatherQuads(
    const float* from, const Int& index, Float& x, Float& y, Float& z, Float& w)
  {
    for (int i = 0; i < Width; ++i)
    {
      const float* quad = from + std::int64_t{ Stride } * index.Of[i];
      x.Of[i] = quad[0];
      y.Of[i] = quad[1];
      z.Of[i] = quad[2];
      w.Of[i] = quad[3];
    }
  }
  /** Loads, for each lane, the three floats at `from + 3 * index`. */
  static void GatherTriples(const float* from, const Int& index, Float& x, Float& y, Float& z)
  {
    for (int i = 0; i < Width; ++i)
    {
      const float* triple = from + std::int64_t{ 3 } * index.Of[i];
      x.Of[i] = triple[0];
      y.Of[i] = triple[1];
      z.Of[i] = triple[2];
    }
  }
  /**
   * Loads the four floats of the vertex ids[index], for an index in the 32 bits of an unsigned
   * integer.
   */
  static void GatherVertices(
    const std::int32_t* ids, const float* vertices, const Int& index, Float (&vertex)[4])
  {
    for (int i = 0; i < Width; ++i)
    {
      const float* quad =
        vertices + 4 * std::int64_t{ ids[static_cast<std::uint32_t>(index.Of[i])] };
      for (int k = 0; k < 4; ++k)
      {
        vertex[k].Of[i] = quad[k];
      }
    }
  }
  /** scalars[cellFace / 4] for each lane. */
  static Float GatherCellScalars(const float* scalars, const Int& cellFace)
  {
    return EachLane<float>([scalars](std::int32_t i) { return scalars[i / 4]; }, cellFace);
  }
  /** table[index], for a table of `Blocks` (1 or 2) times LookupBlock entries. */
  static constexpr int LookupBlock = 8;
  template <int Blocks>
  static Float Lookup(const float* table, const Int& index)
  {
    return EachLane<float>([table](std::int32_t i) { return table[i]; }, index);
  }
  /** The same bits as an integer. */
  static Int AsInt(const Float& a)
  {
    Int result;
    std::memcpy(result.Of, a.Of, sizeof(a.Of));
    return result;
  }
};

}

#endif
