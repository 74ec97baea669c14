// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraMedium.glsl (absorption)
#pragma once

#include "Volume/Optics/MediumConstants.h"

namespace meniscus
{

/** 1 - exp(-x) for x in [0, 1], with an error of at most 1.6e-8: AbsorptionFit::ThickAbsorbed. */
template <class Simd>
inline typename Simd::Float Absorbed(typename Simd::Float x)
{
  constexpr auto& coefficients = AbsorptionFit::ThickAbsorbed;
  constexpr int degree = sizeof(coefficients) / sizeof(float) - 1;
  typename Simd::Float sum = Simd::Splat(coefficients[degree]);
  for (int i = degree - 1; i >= 0; --i)
  {
    sum = Simd::Fma(x, sum, Simd::Splat(coefficients[i]));
  }
  return x * sum;
}

/**
 * 1 - exp(-x) for all x >= 0, with an error of at most 1e-6: beyond 1 it squares exp(-x / 32) five
 * times.
 */
template <class Simd>
inline typename Simd::Float AbsorbedAll(typename Simd::Float x)
{
  using Float = typename Simd::Float;
  const Float one = Simd::Splat(1.0f);
  const Float near = Absorbed<Simd>(Simd::Min(x, one));
  const typename Simd::Mask far = x > one;
  if (Simd::Bits(far) == 0)
  {
    return near;
  }
  // Beyond 32, exp(-x) is below the resolution of the result.
  const Float root = Simd::Min(x, Simd::Splat(32.0f)) * Simd::Splat(1.0f / 32.0f);
  Float left = one - Absorbed<Simd>(root);
  for (int i = 0; i < 5; ++i)
  {
    left = left * left;
  }
  return Simd::Select(far, one - left, near);
}

}
