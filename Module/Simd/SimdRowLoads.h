// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace meniscus
{

/**
 * Loads by an index per lane, for x86: scalar loads of rows, which are then transposed. Gather
 * instructions are slower on some processors and hardly faster on others. See SimdPortable.h for
 * the meaning of the functions.
 *
 * Simd: the set of instructions, which derives from this class and defines TransposeAs(), Pack()
 * and Store().
 */
template <class Simd, int Lanes>
struct SimdRowLoads
{
  template <class Int>
  static Int LoadFrom(const std::int32_t* from, Int index)
  {
    std::int32_t at[Lanes];
    Simd::Store(at, index);
    for (std::int32_t& value : at)
    {
      value = from[static_cast<std::uint32_t>(value)];
    }
    return Simd::Pack(at);
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
  template <class Int, class Float>
  static void GatherVertices(
    const std::int32_t* ids, const float* vertices, Int index, Float (&vertex)[4])
  {
    const Rows rows(index,
      [ids, vertices](std::int32_t i)
      { return vertices + 4 * std::int64_t{ ids[static_cast<std::uint32_t>(i)] }; });
    Simd::TransposeAs(LoadFour(), rows.Of, vertex[0], vertex[1], vertex[2], vertex[3]);
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
