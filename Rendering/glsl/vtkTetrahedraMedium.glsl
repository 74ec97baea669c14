// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/PacketExponential.h (absorption)
// Twin: Module/Volume/Packet/Models/PacketGradientShading.h (light and opacity by gradients)
//
// Light and absorption of a medium, for any number of components.

#if SHADING || GRADIENT_OPACITY
// Effect of the gradient on the pending segment, at its start and end and linear in between: the
// factor of the colour, the light that is added to it, and the factor of the attenuation.
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
#elif CELL_GRADIENTS
  vec3 start = cellGradient(cell);
  vec3 end = start;
#else
  // Scalars of cells have no gradient.
  vec3 start = vec3(0.0);
  vec3 end = start;
#endif
#if SHADING
#if VERTEX_LIGHT
  lightReached = LIGHT_OF(segmentValuesStart);
#endif
  light(start, segmentStartDepth, segmentReflected[0], segmentHighlight[0]);
#if VERTEX_LIGHT
  lightReached = LIGHT_OF(segmentValuesEnd);
#endif
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

// 1 - exp(-x) for x in [0, 1]: see AbsorptionFit in Module/Volume/Optics/MediumConstants.h.
float absorbed(float x)
{
  return x * ABSORBED_PER_DEPTH(x);
}
