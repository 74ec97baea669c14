// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Packets of 16 lanes for processors with AVX-512F; see SimdPortable.h for the meaning of each
 * name.
 */
#pragma once

#include "Simd/SimdRowLoads.h"

#include <immintrin.h>

#include <cstdint>

namespace meniscus
{

struct SimdAVX512 : SimdRowLoads<SimdAVX512, 16>
{
  static constexpr int Width = 16;

  struct Mask
  {
    __mmask16 Lanes;
    friend Mask operator&(Mask a, Mask b) { return { _mm512_kand(a.Lanes, b.Lanes) }; }
    friend Mask operator|(Mask a, Mask b) { return { _mm512_kor(a.Lanes, b.Lanes) }; }
  };

  struct Float
  {
    __m512 V;
    friend Float operator+(Float a, Float b) { return { _mm512_add_ps(a.V, b.V) }; }
    friend Float operator-(Float a, Float b) { return { _mm512_sub_ps(a.V, b.V) }; }
    friend Float operator*(Float a, Float b) { return { _mm512_mul_ps(a.V, b.V) }; }
    friend Float operator/(Float a, Float b) { return { _mm512_div_ps(a.V, b.V) }; }
    friend Mask operator<(Float a, Float b) { return { _mm512_cmp_ps_mask(a.V, b.V, _CMP_LT_OQ) }; }
    friend Mask operator>(Float a, Float b) { return { _mm512_cmp_ps_mask(a.V, b.V, _CMP_GT_OQ) }; }
  };

  struct Int
  {
    __m512i V;
    friend Int operator+(Int a, Int b) { return { _mm512_add_epi32(a.V, b.V) }; }
    friend Int operator-(Int a, Int b) { return { _mm512_sub_epi32(a.V, b.V) }; }
    friend Mask operator<(Int a, Int b) { return { _mm512_cmplt_epi32_mask(a.V, b.V) }; }
    friend Mask operator>(Int a, Int b) { return { _mm512_cmpgt_epi32_mask(a.V, b.V) }; }
  };

  static Float Load(const float* from) { return { _mm512_loadu_ps(from) }; }
  static Int Load(const std::int32_t* from) { return { _mm512_loadu_si512(from) }; }
  static void Store(float* to, Float x) { _mm512_storeu_ps(to, x.V); }
  static void Store(std::int32_t* to, Int x) { _mm512_storeu_si512(to, x.V); }
  static Float Splat(float value) { return { _mm512_set1_ps(value) }; }
  static Int Splat(std::int32_t value) { return { _mm512_set1_epi32(value) }; }

  static Float Fma(Float a, Float b, Float c) { return { _mm512_fmadd_ps(a.V, b.V, c.V) }; }
  static Float SubtractProduct(Float a, Float b, Float c)
  {
    return { _mm512_fnmadd_ps(b.V, c.V, a.V) };
  }
  static Float CrossProduct(Float a, Float b, Float c, Float d)
  {
    const __m512 bc = _mm512_mul_ps(b.V, c.V);
    const __m512 roundOff = _mm512_fnmadd_ps(b.V, c.V, bc);
    return { _mm512_add_ps(_mm512_fmsub_ps(a.V, d.V, bc), roundOff) };
  }
  static Float Min(Float a, Float b) { return { _mm512_min_ps(a.V, b.V) }; }
  static Float Max(Float a, Float b) { return { _mm512_max_ps(a.V, b.V) }; }
  static Float Abs(Float a) { return { _mm512_abs_ps(a.V) }; }
  static Float Sqrt(Float a) { return { _mm512_sqrt_ps(a.V) }; }

  static Float Select(Mask mask, Float yes, Float no)
  {
    return { _mm512_mask_blend_ps(mask.Lanes, no.V, yes.V) };
  }
  static Int Select(Mask mask, Int yes, Int no)
  {
    return { _mm512_mask_blend_epi32(mask.Lanes, no.V, yes.V) };
  }
  static Int One(Mask mask) { return { _mm512_maskz_set1_epi32(mask.Lanes, 1) }; }
  static Mask AndNot(Mask a, Mask b) { return { _mm512_kandn(b.Lanes, a.Lanes) }; }
  static Mask Not(Mask a) { return { _mm512_knot(a.Lanes) }; }
  static unsigned int Bits(Mask mask) { return mask.Lanes; }
  static Mask FromBits(unsigned int bits) { return { static_cast<__mmask16>(bits) }; }

  static Int Increment(Mask mask, Int a)
  {
    return { _mm512_mask_add_epi32(a.V, mask.Lanes, a.V, _mm512_set1_epi32(1)) };
  }
  static Int Decrement(Mask mask, Int a)
  {
    return { _mm512_mask_sub_epi32(a.V, mask.Lanes, a.V, _mm512_set1_epi32(1)) };
  }
  static Int And(Int a, Int b) { return { _mm512_and_si512(a.V, b.V) }; }
  static Float ToFloat(Int a) { return { _mm512_cvtepi32_ps(a.V) }; }
  static Int ToInt(Float a) { return { _mm512_cvtps_epi32(a.V) }; }
  static Int ShiftRight(Int a, Int b) { return { _mm512_srlv_epi32(a.V, b.V) }; }
  static Int LookupOf24(const std::int32_t (&table)[32], Int index)
  {
    return { _mm512_permutex2var_epi32(
      _mm512_loadu_si512(table), index.V, _mm512_loadu_si512(table + 16)) };
  }
  /**
   * The lower and the upper halves of numbers that have just been loaded one by one. Load() would
   * wait for parts of the array to be stored.
   */
  static void PackPairs(const std::int64_t (&x)[Width], Int& first, Int& second)
  {
    const __m512i low = _mm512_setr_epi64(x[0], x[1], x[4], x[5], x[8], x[9], x[12], x[13]);
    const __m512i high = _mm512_setr_epi64(x[2], x[3], x[6], x[7], x[10], x[11], x[14], x[15]);
    const __m512 a = _mm512_castsi512_ps(low);
    const __m512 b = _mm512_castsi512_ps(high);
    first.V = _mm512_castps_si512(_mm512_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)));
    second.V = _mm512_castps_si512(_mm512_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)));
  }
  /** Loads four floats from each of the rows, by `load`, and transposes them. */
  template <typename LoadRow>
  static void TransposeAs(
    const LoadRow& load, const float* const (&rows)[Width], Float& x, Float& y, Float& z, Float& w)
  {
    const auto row = [&rows, &load](int i)
    {
      __m512 r = _mm512_castps128_ps512(load(rows[i]));
      r = _mm512_insertf32x4(r, load(rows[i + 4]), 1);
      r = _mm512_insertf32x4(r, load(rows[i + 8]), 2);
      return _mm512_insertf32x4(r, load(rows[i + 12]), 3);
    };
    const __m512 r0 = row(0);
    const __m512 r1 = row(1);
    const __m512 r2 = row(2);
    const __m512 r3 = row(3);
    const __m512 xy01 = _mm512_unpacklo_ps(r0, r1);
    const __m512 xy23 = _mm512_unpacklo_ps(r2, r3);
    const __m512 zw01 = _mm512_unpackhi_ps(r0, r1);
    const __m512 zw23 = _mm512_unpackhi_ps(r2, r3);
    x.V = _mm512_shuffle_ps(xy01, xy23, _MM_SHUFFLE(1, 0, 1, 0));
    y.V = _mm512_shuffle_ps(xy01, xy23, _MM_SHUFFLE(3, 2, 3, 2));
    z.V = _mm512_shuffle_ps(zw01, zw23, _MM_SHUFFLE(1, 0, 1, 0));
    w.V = _mm512_shuffle_ps(zw01, zw23, _MM_SHUFFLE(3, 2, 3, 2));
  }
  static Float GatherCellScalars(const float* scalars, Int cellFace)
  {
    return { _mm512_i32gather_ps(_mm512_srli_epi32(cellFace.V, 2), scalars, 4) };
  }
  static constexpr int LookupBlock = 16;
  template <int Blocks>
  static Float Lookup(const float* table, Int index)
  {
    if (Blocks == 1)
    {
      return { _mm512_permutexvar_ps(index.V, _mm512_loadu_ps(table)) };
    }
    return { _mm512_permutex2var_ps(_mm512_loadu_ps(table), index.V, _mm512_loadu_ps(table + 16)) };
  }
  static Int AsInt(Float a) { return { _mm512_castps_si512(a.V) }; }
};

}
