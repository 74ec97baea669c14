// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/IntensityProjectionModel.h (one number per ray)
//
// Blending that keeps one number per ray: the largest or smallest scalar or the scalar's mean,
// mapped by the transfer function, or the integral of opacity times scalar, shown as a grey level.

#if BLEND_MODE == MAXIMUM_INTENSITY
#define REDUCE max
const float NEUTRAL = -1.0e+30;
#elif BLEND_MODE == MINIMUM_INTENSITY
#define REDUCE min
const float NEUTRAL = 1.0e+30;
#else
const float NEUTRAL = 0.0;
#endif

float collected;
float collectedRest; // rounding error of the sum: long rays add thousands of small terms
float visibleLength;

void startRay()
{
  collected = NEUTRAL;
  collectedRest = 0.0;
  visibleLength = 0.0;
}

bool isRayDone()
{
  return false;
}

// Compensated summation (W. Kahan).
void collect(float term)
{
  EXACTLY_AS_WRITTEN float corrected = term - collectedRest;
  EXACTLY_AS_WRITTEN float sum = collected + corrected;
  EXACTLY_AS_WRITTEN float rest = (sum - collected) - corrected;
  collectedRest = rest;
  collected = sum;
}

#if BLEND_MODE == ADDITIVE

uniform vec2 rangeShare;             // position in the data's range: at 0, per scalar

// Larger parts of an integral, which is shown up to 1, count as this: sums of infinity and its
// rounding error would not be numbers.
const float LARGEST_TERM = 18446744073709551616.0; // 2^64

void startPart(float scalar)
{
  findInterval(scalar);
}

// Attenuation times the scalar's position in the data's range is quadratic along a piece: Simpson's
// rule is exact.
bool integratePiece()
{
  float to;
  float reached;
  int next;
  bool last = findPiece(to, reached, next);
  float pieceLength = (reached - segmentDone) * segmentLength;
  vec3 scalars = vec3(segmentScalar, 0.5 * (segmentScalar + to), to);
  vec3 attenuations = intervalRange.z + (scalars - intervalRange.x) * intervalRange.w;
  vec3 values = max(attenuations, 0.0) * (rangeShare.x + rangeShare.y * scalars);
  collect(min(pieceLength * dot(vec3(1.0, 4.0, 1.0) / 6.0, values), LARGEST_TERM));
  visibleLength += pieceLength;
  segmentDone = reached;
  segmentScalar = to;
  if (!last)
  {
    interval = next;
    loadInterval();
  }
  return last;
}

vec4 finishRay()
{
  float grey = clamp(collected, 0.0, 1.0);
  return visibleLength > 0.0 ? vec4(vec3(grey), 1.0) : vec4(0.0);
}

#else

void startPart(float scalar)
{
}

bool integratePiece()
{
#if BLEND_MODE == AVERAGE_INTENSITY
  collect(0.5 * (segmentStart + segmentEnd) * segmentLength);
#else
  collected = REDUCE(collected, REDUCE(segmentStart, segmentEnd));
#endif
  visibleLength += segmentLength;
  return true;
}

vec4 finishRay()
{
  if (visibleLength <= 0.0)
  {
    return vec4(0.0);
  }
#if BLEND_MODE == AVERAGE_INTENSITY
  vec4 shown = lookUp(collected / visibleLength);
#else
  vec4 shown = lookUp(collected);
#endif
  float alpha = clamp(shown.a, 0.0, 1.0);
  return vec4(alpha * shown.rgb, alpha);
}

#endif
