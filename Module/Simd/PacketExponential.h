// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Simd_PacketExponential_h
#define meniscus_Simd_PacketExponential_h

namespace meniscus
{

/**
 * 1 - exp(-x) for x in [0, 1], with an error of at most 2e-9: x times a Chebyshev interpolant of (1
 * - exp(-x)) / x.
 */
template <class Simd>
inline typename Simd::Float Absorbed(typename Simd::Float x)
{
  constexpr float coefficients[] = { -0.00130077495785f, 0.00827550484353f, -0.04164684931339f,
    0.16666340311502f, -0.49999979725212f, 0.99999999793357f };
  typename Simd::Float sum = Simd::Splat(0.00012907631016f);
  for (const float coefficient : coefficients)
  {
    sum = Simd::Fma(x, sum, Simd::Splat(coefficient));
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

#endif
