// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Constants of the density-emitter integral. The packet models use them as they stand here; shaders
 * get them from Rendering/Backends/OpenGL/ShaderConstants.cxx. Data only: files of different
 * instruction sets share it.
 */
#pragma once

namespace meniscus
{

/**
 * Polynomials of the optical depth t of a part and the density a at its front, lowest power first.
 *
 * Absorbed: 1 - exp(-t), divided by t.
 * Mean: 1 - psi, the mean over the part of the absorption up to a place, which is the integral over
 * x in [0, 1] of 1 - exp(-(a x + (t - a) x^2)). Row j belongs to a^j; row 0 is multiplied by t.
 * Fitted for all densities that are nowhere negative: a in [0, 2 t].
 *
 * Largest absolute errors with these floats, in the product with t for Absorbed: Thin, for
 * t <= 1/8, 4.1e-9 and 3.8e-8; Thick, for t <= 1, 1.6e-8 and 2.9e-7. They are measured by
 * scripts/fit_polynomials.py, which also fits the polynomials.
 */
struct AbsorptionFit
{
  static constexpr float ThinAbsorbed[4] = { 0.999999972267f, -0.499995547289f, 0.166505568729f,
    -0.039642346780f };
  static constexpr float ThinMean[4][3] = { { 0.3333348310f, -0.0999958838f, 0.0231317024f },
    { 0.1666630304f, -0.0499135420f, 0.0111462326f }, { -0.0166403724f, 0.0044698893f, 0.0f },
    { 0.0011184650f, 0.0f, 0.0f } };
  static constexpr float ThickAbsorbed[7] = { 0.99999999793357f, -0.49999979725212f,
    0.16666340311502f, -0.04164684931339f, 0.00827550484353f, -0.00130077495785f,
    0.00012907631016f };
  static constexpr float ThickMean[6][5] = {
    { 0.3333333333f, -0.0999792881f, 0.0236830118f, -0.0043518064f, 0.0004903571f },
    { 0.1666666667f, -0.0500173281f, 0.0119526605f, -0.0023320093f, 0.0003181505f },
    { -0.0166512718f, 0.0047084626f, -0.0008994605f, 0.0000935654f, 0.0f },
    { 0.0011768438f, -0.0003058993f, 0.0000410537f, 0.0f, 0.0f },
    { -0.0000596959f, 0.0000104829f, 0.0f, 0.0f, 0.0f }, { 0.0000017222f, 0.0f, 0.0f, 0.0f, 0.0f }
  };
};

/**
 * Strength, at most, of a light at a place, where its falloff is 0 or next to it: 2^64, so that
 * products of a strength, a colour and powers of cosines are finite in single precision.
 */
constexpr float LargestLightStrength = 18446744073709551616.0f;

/**
 * Least value of 1 + g^2 - 2 g c, the base of Henyey and Greenstein's phase function. Its rounding
 * error is up to 2^-22, so that lower values would have no correct digits.
 */
constexpr float SmallestTurn = 1.0f / 1048576.0f; // 2^-20

/** Optical depth beyond which nothing can be told apart; its square is finite. */
constexpr float LargestDepth = 1.0e+18f;

/**
 * Optical depth at which a part of a medium of several components ends. There Gauss' rule of three
 * points, exact for polynomials of the fifth degree, integrates emission times transmittance to
 * 1e-6 of the largest emission.
 */
constexpr float LargestGaussDepth = 0.5f;
/**
 * Attenuation by the medium behind a membrane along such a part. Together with an optical depth of
 * LargestGaussDepth, an emission that is quadratic times the exponential of the sum, at most 3/4,
 * has a sixth derivative of at most 30 (3/4)^4 of its own quadratic term: that rule's error,
 * 1/2016000 of it, is below 5e-6 of the largest emission.
 */
constexpr float LargestFadedDepth = 0.25f;
/** Attenuation beyond which nothing is seen through that medium: 24 binary digits. */
constexpr float InvisibleDepth = 16.7f;
/** Places of that rule on both sides of the middle of [0, 1]: sqrt(3/5) / 2. */
constexpr float GaussPlace = 0.3872983346207417f;
/** Weights of an outer place and of the middle. */
constexpr float GaussWeights[2] = { 5.0f / 18.0f, 8.0f / 18.0f };

/**
 * Change of a normalised scalar along a segment from which on the segment does not count: scalars
 * are in [-1, 1], and a vertex without a scalar has NaN.
 */
constexpr float LargestChange = 4.0f;

}
