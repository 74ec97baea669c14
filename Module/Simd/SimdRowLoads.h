// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <cstdint>
#include <cstring>

namespace meniscus
{

/**
 * Loads by an index per lane, for x86: scalar loads of rows, which are then transposed. Gather
 * instructions are slower on some processors and hardly faster on others. See SimdPortable.h for
 * the meaning of the functions.
 *
 * Simd: the set of instructions, which derives from this class and defines TransposeAs(),
 * PackPairs() and Store().
 */
template <class Simd, int Lanes>
struct SimdRowLoads
{
  template <class Int>
  static void FollowPairs(const std::int32_t* pairs, Int index, Int& first, Int& second)
  {
    std::int32_t at[Lanes];
    Simd::Store(at, index);
    std::int64_t loaded[Lanes];
    for (int i = 0; i < Lanes; ++i)
    {
      const std::int32_t* pair = pairs + std::int64_t{ 2 } * at[i];
      std::memcpy(&loaded[i], pair, sizeof(loaded[i]));
      // An address that is not in the table is ignored.
      const auto next = reinterpret_cast<std::uintptr_t>(pairs) + sizeof(loaded[i]) * *pair;
      __builtin_prefetch(reinterpret_cast<const void*>(next));
    }
    Simd::PackPairs(loaded, first, second);
  }

  template <int Stride, class Int, class Float>
  static void GatherQuads(const float* from, Int index, Float& x, Float& y, Float& z, Float& w)
  {
    const Rows rows(index, [from](std::int32_t i) { return from + std::int64_t{ Stride } * i; });
    Simd::TransposeAs(LoadFour(), rows.Of, x, y, z, w);
  }
  template <class Int, class Float>
  static void GatherTriples(const float* from, Int index, Float& x, Float& y, Float& z)
  {
    const Rows rows(index, [from](std::int32_t i) { return from + std::int64_t{ 3 } * i; });
    // The mask prevents reads beyond the third value.
    const __m128i three = _mm_setr_epi32(-1, -1, -1, 0);
    Float none;
    Simd::TransposeAs(
      [three](const float* row) { return _mm_maskload_ps(row, three); }, rows.Of, x, y, z, none);
  }

private:
  struct LoadFour
  {
    __m128 operator()(const float* row) const { return _mm_loadu_ps(row); }
  };

  /** The row of each lane. */
  struct Rows
  {
    const float* Of[Lanes];

    template <class Int, class RowOf>
    Rows(Int index, const RowOf& rowOf)
    {
      std::int32_t at[Lanes];
      Simd::Store(at, index);
      for (int i = 0; i < Lanes; ++i)
      {
        this->Of[i] = rowOf(at[i]);
      }
    }
  };
};

}
