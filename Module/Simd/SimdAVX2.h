// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Packets of 8 lanes for processors with AVX2 and FMA; see SimdPortable.h for the meaning of each
 * name.
 */
#pragma once

#include "Simd/SimdRowLoads.h"

#include <immintrin.h>

#include <cstdint>

namespace meniscus
{

struct SimdAVX2 : SimdRowLoads<SimdAVX2, 8>
{
  static constexpr int Width = 8;

  struct Mask
  {
    __m256 Bits;
    friend Mask operator&(Mask a, Mask b) { return { _mm256_and_ps(a.Bits, b.Bits) }; }
    friend Mask operator|(Mask a, Mask b) { return { _mm256_or_ps(a.Bits, b.Bits) }; }
  };

  struct Float
  {
    __m256 V;
    friend Float operator+(Float a, Float b) { return { _mm256_add_ps(a.V, b.V) }; }
    friend Float operator-(Float a, Float b) { return { _mm256_sub_ps(a.V, b.V) }; }
    friend Float operator*(Float a, Float b) { return { _mm256_mul_ps(a.V, b.V) }; }
    friend Float operator/(Float a, Float b) { return { _mm256_div_ps(a.V, b.V) }; }
    friend Mask operator<(Float a, Float b) { return { _mm256_cmp_ps(a.V, b.V, _CMP_LT_OQ) }; }
    friend Mask operator>(Float a, Float b) { return { _mm256_cmp_ps(a.V, b.V, _CMP_GT_OQ) }; }
  };

  struct Int
  {
    __m256i V;
    friend Int operator+(Int a, Int b) { return { _mm256_add_epi32(a.V, b.V) }; }
    friend Int operator-(Int a, Int b) { return { _mm256_sub_epi32(a.V, b.V) }; }
    friend Mask operator<(Int a, Int b) { return b > a; }
    friend Mask operator>(Int a, Int b)
    {
      return { _mm256_castsi256_ps(_mm256_cmpgt_epi32(a.V, b.V)) };
    }
  };

  static Float Load(const float* from) { return { _mm256_loadu_ps(from) }; }
  static Int Load(const std::int32_t* from)
  {
    return { _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)) };
  }
  static void Store(float* to, Float x) { _mm256_storeu_ps(to, x.V); }
  static void Store(std::int32_t* to, Int x)
  {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), x.V);
  }
  static Float Splat(float value) { return { _mm256_set1_ps(value) }; }
  static Int Splat(std::int32_t value) { return { _mm256_set1_epi32(value) }; }

  static Float Fma(Float a, Float b, Float c) { return { _mm256_fmadd_ps(a.V, b.V, c.V) }; }
  static Float SubtractProduct(Float a, Float b, Float c)
  {
    return { _mm256_fnmadd_ps(b.V, c.V, a.V) };
  }
  static Float CrossProduct(Float a, Float b, Float c, Float d)
  {
    const __m256 bc = _mm256_mul_ps(b.V, c.V);
    const __m256 roundOff = _mm256_fnmadd_ps(b.V, c.V, bc);
    return { _mm256_add_ps(_mm256_fmsub_ps(a.V, d.V, bc), roundOff) };
  }
  static Float Min(Float a, Float b) { return { _mm256_min_ps(a.V, b.V) }; }
  static Float Max(Float a, Float b) { return { _mm256_max_ps(a.V, b.V) }; }
  static Float Abs(Float a) { return { _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.V) }; }
  static Float Sqrt(Float a) { return { _mm256_sqrt_ps(a.V) }; }

  static Float Select(Mask mask, Float yes, Float no)
  {
    return { _mm256_blendv_ps(no.V, yes.V, mask.Bits) };
  }
  static Int Select(Mask mask, Int yes, Int no)
  {
    return { _mm256_castps_si256(
      _mm256_blendv_ps(_mm256_castsi256_ps(no.V), _mm256_castsi256_ps(yes.V), mask.Bits)) };
  }
  static Int One(Mask mask) { return { _mm256_srli_epi32(_mm256_castps_si256(mask.Bits), 31) }; }
  static Mask AndNot(Mask a, Mask b) { return { _mm256_andnot_ps(b.Bits, a.Bits) }; }
  static Mask Not(Mask a)
  {
    const __m256i all = _mm256_set1_epi32(-1);
    return { _mm256_xor_ps(a.Bits, _mm256_castsi256_ps(all)) };
  }
  static unsigned int Bits(Mask mask)
  {
    return static_cast<unsigned int>(_mm256_movemask_ps(mask.Bits));
  }
  static Mask FromBits(unsigned int bits)
  {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lane);
    return { _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lane)) };
  }

  static Int Increment(Mask mask, Int a)
  {
    return { _mm256_sub_epi32(a.V, _mm256_castps_si256(mask.Bits)) };
  }
  static Int Decrement(Mask mask, Int a)
  {
    return { _mm256_add_epi32(a.V, _mm256_castps_si256(mask.Bits)) };
  }
  static Int And(Int a, Int b) { return { _mm256_and_si256(a.V, b.V) }; }
  static Float ToFloat(Int a) { return { _mm256_cvtepi32_ps(a.V) }; }
  static Int ToInt(Float a) { return { _mm256_cvtps_epi32(a.V) }; }
  static Int ShiftRight(Int a, Int b) { return { _mm256_srlv_epi32(a.V, b.V) }; }
  static Int LookupOf24(const std::int32_t (&table)[32], Int index)
  {
    const auto part = [&](int first)
    { return Int{ _mm256_permutevar8x32_epi32(Load(table + first).V, index.V) }; };
    // Bits 3 and 4 of the index, shifted to the sign bit, which the blend tests.
    const Mask second{ _mm256_castsi256_ps(_mm256_slli_epi32(index.V, 28)) };
    const Mask third{ _mm256_castsi256_ps(_mm256_slli_epi32(index.V, 27)) };
    return Select(third, part(16), Select(second, part(8), part(0)));
  }
  /**
   * The lower and the upper halves of numbers that have just been loaded one by one. Load() would
   * wait for parts of the array to be stored.
   */
  static void PackPairs(const std::int64_t (&x)[Width], Int& first, Int& second)
  {
    const __m256i low = _mm256_setr_epi64x(x[0], x[1], x[4], x[5]);
    const __m256i high = _mm256_setr_epi64x(x[2], x[3], x[6], x[7]);
    const __m256 a = _mm256_castsi256_ps(low);
    const __m256 b = _mm256_castsi256_ps(high);
    first.V = _mm256_castps_si256(_mm256_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)));
    second.V = _mm256_castps_si256(_mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)));
  }
  /** Loads four floats from each of the rows, by `load`, and transposes them. */
  template <typename LoadRow>
  static void TransposeAs(
    const LoadRow& load, const float* const (&rows)[Width], Float& x, Float& y, Float& z, Float& w)
  {
    const auto pair = [&rows, &load](int i)
    { return _mm256_insertf128_ps(_mm256_castps128_ps256(load(rows[i])), load(rows[i + 4]), 1); };
    const __m256 r0 = pair(0);
    const __m256 r1 = pair(1);
    const __m256 r2 = pair(2);
    const __m256 r3 = pair(3);
    const __m256 xy01 = _mm256_unpacklo_ps(r0, r1);
    const __m256 xy23 = _mm256_unpacklo_ps(r2, r3);
    const __m256 zw01 = _mm256_unpackhi_ps(r0, r1);
    const __m256 zw23 = _mm256_unpackhi_ps(r2, r3);
    x.V = _mm256_shuffle_ps(xy01, xy23, _MM_SHUFFLE(1, 0, 1, 0));
    y.V = _mm256_shuffle_ps(xy01, xy23, _MM_SHUFFLE(3, 2, 3, 2));
    z.V = _mm256_shuffle_ps(zw01, zw23, _MM_SHUFFLE(1, 0, 1, 0));
    w.V = _mm256_shuffle_ps(zw01, zw23, _MM_SHUFFLE(3, 2, 3, 2));
  }
  static Float GatherCellScalars(const float* scalars, Int cellFace)
  {
    return { _mm256_i32gather_ps(scalars, _mm256_srli_epi32(cellFace.V, 2), 4) };
  }
  static constexpr int LookupBlock = 8;
  template <int Blocks>
  static Float Lookup(const float* table, Int index)
  {
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), index.V);
    if (Blocks == 1)
    {
      return { low };
    }
    const __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), index.V);
    // Bit 3 of the index, shifted to the sign bit, which the blend tests.
    const __m256 second = _mm256_castsi256_ps(_mm256_slli_epi32(index.V, 28));
    return { _mm256_blendv_ps(low, high, second) };
  }
  static Int AsInt(Float a) { return { _mm256_castps_si256(a.V) }; }
};

}
