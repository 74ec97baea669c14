// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light and absorption of a medium, for one or several components.

// Optical depth of a piece beyond which nothing can be told apart; its square is finite.
const float LARGEST_DEPTH = 1.0e+18;

#if SHADING || GRADIENT_OPACITY
// What the gradient does to the pending segment, at its start and end and linear between: light that
// multiplies the colour, light that is added to it, and the factor of the attenuation.
vec3 segmentReflected[2];
vec3 segmentHighlight[2];
vec2 segmentOpacity;

void lightSegment()
{
  if (segmentDone > 0.0)
  {
    return;
  }
#if VERTEX_GRADIENTS
  vec3 start = GRADIENT_OF(segmentValuesStart);
  vec3 end = GRADIENT_OF(segmentValuesEnd);
#else
  vec3 start = cellGradient(cell);
  vec3 end = start;
#endif
#if SHADING
  light(start, segmentStartDepth, segmentReflected[0], segmentHighlight[0]);
  light(end, segmentEndDepth, segmentReflected[1], segmentHighlight[1]);
#endif
#if GRADIENT_OPACITY
  segmentOpacity = vec2(gradientOpacity(start), gradientOpacity(end));
#endif
}

#if SHADING
vec3 shade(vec3 emitted, float done)
{
  return emitted * mix(segmentReflected[0], segmentReflected[1], done) +
    mix(segmentHighlight[0], segmentHighlight[1], done);
}
#endif
#endif

// 1 - exp(-x) for x in [0, 1], to 2e-9: x times a Chebyshev interpolant of (1 - exp(-x)) / x.
float absorbed(float x)
{
  return x * (0.99999999793357 + x * (-0.49999979725212 + x * (0.16666340311502 +
    x * (-0.04164684931339 + x * (0.00827550484353 +
    x * (-0.00130077495785 + x * 0.00012907631016))))));
}
