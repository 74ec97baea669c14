// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/PacketFadedMedium.h (light that a medium takes and scatters)
//
// Fading of the light that a volume emits, on its way through the medium in front of it: a colour c
// at a path length d is seen as s c + (1 - s) M, with the medium's colour M and the share s of d.

// Way through the medium to a fraction of the pending segment.
float mediumPath(float done)
{
  float depth = mix(segmentStartDepth, segmentEndDepth, done);
  return max(0.0, legPath + (depth - legStart) * (rayLengthPerDepth * GRID_PER_DEPTH));
}

// Fraction of the part of the segment between two fractions of it that may be integrated at once:
// up to an attenuation of LARGEST_FADED_DEPTH in every channel that can be seen, or to a bend of
// the linear share. 1 if the ends of the part ahead are equal in single precision.
float fadedPart(float from, float to)
{
  if (rayLeg == 0)
  {
    return 1.0;
  }
  float path = mediumPath(from);
  float way = (to - from) * segmentLength;
  float limit = 1.0;
  if (mediumIsLinear)
  {
    vec2 ahead = mediumRange - path;
    limit = ahead.x > 0.0 && ahead.x < way ? ahead.x / way : limit;
    limit = ahead.y > 0.0 && ahead.y < way ? min(limit, ahead.y / way) : limit;
  }
  else
  {
    bvec3 gone = greaterThan(mediumAttenuation * path, vec3(INVISIBLE_DEPTH));
    vec3 seen = mix(mediumAttenuation, vec3(0.0), gone);
    float largest = max(seen.r, max(seen.g, seen.b));
    limit = min(1.0, LARGEST_FADED_DEPTH / max(largest * way, 1.0e-30));
  }
  return limit * (to - from) < 1.0 / 4194304.0 ? 1.0 : limit;
}

// A density times a colour that is emitted at a fraction of the segment.
vec3 faded(float density, vec3 emission, float done)
{
  if (rayLeg == 0)
  {
    return emission;
  }
  return mix(density * mediumColor, emission, seenThroughMedium(mediumPath(done)));
}
