// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace meniscus
{

/**
 * Values that models interpolate besides depth and scalar: vectors of three numbers per vertex, for
 * one vertex per lane. Without such vectors the functions do nothing.
 */
template <class Simd, int Triples>
struct VertexAttributes
{
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;
  static constexpr int Size = 3 * Triples;

  std::array<Float, Size> Of;

  void Clear() { this->Of.fill(Simd::Splat(0.0f)); }

  /** @param tables  three numbers per vertex each. */
  void Gather(const float* const (&tables)[3], Int vertex)
  {
    static_assert(Triples <= 3, "as many as there are tables");
    for (int triple = 0; triple < Triples; ++triple)
    {
      Float* to = this->Of.data() + 3 * triple;
      Simd::GatherTriples(tables[triple], vertex, to[0], to[1], to[2]);
    }
  }

  void Replace(Mask lanes, const VertexAttributes& by)
  {
    for (int i = 0; i < Size; ++i)
    {
      this->Of[i] = Simd::Select(lanes, by.Of[i], this->Of[i]);
    }
  }

  /** Values at the fraction `share` of the way to `to`. */
  VertexAttributes Between(Float share, const VertexAttributes& to) const
  {
    VertexAttributes result;
    for (int i = 0; i < Size; ++i)
    {
      result.Of[i] = Simd::Fma(share, to.Of[i] - this->Of[i], this->Of[i]);
    }
    return result;
  }
};

}
