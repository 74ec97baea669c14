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
  /**
   * a * d - b * c, for exact factors. The error is at most 2^-22 of |b c|, which may change the
   * sign of the result.
   */
  static Float CrossProduct(const Float& a, const Float& b, const Float& c, const Float& d)
  {
    return a * d - b * c;
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
  /**
   * The upper half of the 64-bit value a * b + addend, rounded down. The addends of even and odd
   * lanes are in separate arrays.
   */
  static Int MultiplyHigh(const Int& a, const std::int32_t* b, const std::int64_t* evenAddend,
    const std::int64_t* oddAddend)
  {
    Int result;
    for (int i = 0; i < Width; ++i)
    {
      const std::int64_t addend = (i % 2 == 0 ? evenAddend : oddAddend)[i / 2];
      result.Of[i] = static_cast<std::int32_t>((std::int64_t{ a.Of[i] } * b[i] + addend) >> 32);
    }
    return result;
  }
  /** of[index] for each lane. */
  static Int Pick(const Int& index, const Int (&of)[4])
  {
    Int result;
    for (int i = 0; i < Width; ++i)
    {
      result.Of[i] = of[index.Of[i]].Of[i];
    }
    return result;
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
   * For the cell cellFace / 4 and its face cellFace % 4: loads the links of the cell, the last four
   * of the eight integers at `cells + 8 cell`, and the four floats of its vertex opposite the face.
   */
  static void GatherCells(const std::int32_t* cells, const float* vertices, const Int& cellFace,
    Int (&links)[4], Float (&vertex)[4])
  {
    for (int i = 0; i < Width; ++i)
    {
      const std::int64_t face = cellFace.Of[i] % 4;
      const std::int32_t* cell = cells + 2 * (cellFace.Of[i] - face);
      const float* opposite = vertices + 4 * std::int64_t{ cell[face] };
      for (int k = 0; k < 4; ++k)
      {
        links[k].Of[i] = cell[4 + k];
        vertex[k].Of[i] = opposite[k];
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
