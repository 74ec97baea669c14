// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/PreIntegratedModel.h (parts of a segment)
// Twin: Module/Volume/Packet/Models/PacketSegmentTable.cxx (look-up in the table)
//
// Composite blending by a table of pre-integrated segments, see
// Module/Volume/Optics/PreIntegration.h.

uniform sampler3D preIntegrated;     // colour / opacity, mean attenuation
uniform float preIntegratedScalars;  // number of scalars
uniform float shortestLengthReciprocal;
uniform float lengthsPerOctave;
uniform vec2 preIntegratedRange;     // middle, and the reciprocal of half the width

void startPart(float scalar)
{
}

// Interpolates the table at a place counted in its values. Filters of graphics devices round the
// place to 1/256 of the distance of values, which is too coarse for steep functions.
vec4 lookUp(vec3 place)
{
  ivec3 last = textureSize(preIntegrated, 0) - 1;
  ivec3 low = clamp(ivec3(floor(place)), ivec3(0), last);
  ivec3 high = min(low + 1, last);
  vec3 part = clamp(place - vec3(low), 0.0, 1.0);
  vec4 planes[2];
  for (int i = 0; i < 2; ++i)
  {
    int z = i == 0 ? low.z : high.z;
    vec4 near = mix(texelFetch(preIntegrated, ivec3(low.xy, z), 0),
      texelFetch(preIntegrated, ivec3(high.x, low.y, z), 0), part.x);
    vec4 far = mix(texelFetch(preIntegrated, ivec3(low.x, high.y, z), 0),
      texelFetch(preIntegrated, ivec3(high.xy, z), 0), part.x);
    planes[i] = mix(near, far, part.y);
  }
  return mix(planes[0], planes[1], part.z);
}

// Adds a part of the segment between two places of the table, in [-1, 1].
void addPart(vec2 places, float partLength)
{
  // The lengths are 0, then a geometric sequence.
  float relative = partLength * shortestLengthReciprocal;
  float at = relative < 1.0 ? relative : 1.0 + lengthsPerOctave * log2(relative);
  vec2 scalars = (0.5 * places + 0.5) * (preIntegratedScalars - 1.0);
  vec4 mean = lookUp(vec3(scalars, at));
  float gone = 1.0 - exp(-mean.a * partLength);
  color += transmittance * gone * mean.rgb;
  transmittance -= transmittance * gone;
}

// Integrates the next part of the pending segment: before, within or behind the range of the table,
// outside of which the function is constant. One part per turn reads the table in one place only:
// llvmpipe executes all branches. Returns true if the segment is done.
bool integratePiece()
{
  vec2 ends = (vec2(segmentStart, segmentEnd) - preIntegratedRange.x) * preIntegratedRange.y;
  vec2 within = clamp(ends, -1.0, 1.0);
  float change = ends.y - ends.x;
  vec2 met = (within - vec2(ends.x)) / change;
  float entered = ends.x == within.x ? 0.0 : (change == 0.0 ? 1.0 : clamp(met.x, 0.0, 1.0));
  float left = ends.y == within.y ? 1.0 : (change == 0.0 ? entered : clamp(met.y, entered, 1.0));
  bool before = segmentDone < entered;
  bool behind = segmentDone >= left;
  float reached = before ? entered : (behind ? 1.0 : left);
  addPart(before ? within.xx : (behind ? within.yy : within),
    (reached - segmentDone) * segmentLength);
  segmentDone = reached;
  return reached >= 1.0;
}
