// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Composite blending by a table of pre-integrated segments, see Module/Volume/PreIntegration.h.

uniform sampler3D preIntegrated;     // colour / opacity, mean attenuation
uniform vec2 preIntegratedSize;      // numbers of scalars and of lengths
uniform float shortestLengthReciprocal;
uniform float lengthsPerOctave;

void startPart(float scalar)
{
}

bool integratePiece()
{
  // The lengths are 0, then a geometric sequence.
  float relative = segmentLength * shortestLengthReciprocal;
  float at = relative < 1.0 ? relative : 1.0 + lengthsPerOctave * log2(relative);
  vec2 scalars = (0.5 * vec2(segmentStart, segmentEnd) + 0.5) * (preIntegratedSize.x - 1.0);
  vec4 mean = textureLod(
    preIntegrated, (vec3(scalars, at) + vec3(0.5)) / preIntegratedSize.xxy, 0.0);
  float gone = 1.0 - exp(-mean.a * segmentLength);
  color += transmittance * gone * mean.rgb;
  transmittance -= transmittance * gone;
  return true;
}
