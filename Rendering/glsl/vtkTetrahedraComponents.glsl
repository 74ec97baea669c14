// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/MultiComponentModel.h (integral of several components)
//
// Composite blending of scalars of several components. Each is linear in a cell. A segment is split
// where one of them passes a node of its function. On a piece, attenuation is linear, and emission
// (attenuation times colour) is quadratic.

// The functions, in the order of the scalars that are their arguments: the main scalar, then the
// other components unless they are colours.
uniform int functionStart[NUMBER_OF_FUNCTIONS];
uniform int functionSize[NUMBER_OF_FUNCTIONS];

const vec3 GAUSS_WEIGHTS = vec3(OUTER_GAUSS_WEIGHT, MIDDLE_GAUSS_WEIGHT, OUTER_GAUSS_WEIGHT);

// Current interval of each function: its index; its lower and upper end, attenuation and slope; its
// colours; and the scalar up to which the pending segment has been integrated.
int functionInterval[NUMBER_OF_FUNCTIONS];
vec4 functionRange[NUMBER_OF_FUNCTIONS];
vec3 functionColor[NUMBER_OF_FUNCTIONS];
vec3 functionColorSlope[NUMBER_OF_FUNCTIONS];
float functionScalar[NUMBER_OF_FUNCTIONS];

void loadFunctionInterval(int f)
{
  int at = 3 * functionInterval[f];
  functionRange[f] = texelFetch(intervals, at);
  functionColor[f] = texelFetch(intervals, at + 1).rgb;
  functionColorSlope[f] = texelFetch(intervals, at + 2).rgb;
}

float scalarOf(int f, float mainScalar, vec3 others)
{
  return f == 0 ? mainScalar : (f == 1 ? others.x : (f == 2 ? others.y : others.z));
}

void startPart(float scalar)
{
  for (int f = 0; f < NUMBER_OF_FUNCTIONS; ++f)
  {
    float wanted = scalarOf(f, scalar, COMPONENTS_OF(faceValues));
    int low = functionStart[f];
    int high = low + functionSize[f] - 1;
    while (low < high)
    {
      int middle = (low + high) / 2;
      bool above = texelFetch(intervals, 3 * middle).y < wanted;
      low = above ? middle + 1 : low;
      high = above ? high : middle;
    }
    functionInterval[f] = low;
    loadFunctionInterval(f);
  }
}

// Attenuation times length, and colour, of a function at a scalar in its interval.
float densityAt(int f, float scalar, float pieceLength)
{
  float attenuation = functionRange[f].z + (scalar - functionRange[f].x) * functionRange[f].w;
  return clamp(attenuation * pieceLength, 0.0, LARGEST_DEPTH);
}

vec3 colorAt(int f, float scalar)
{
  return functionColor[f] + (scalar - functionRange[f].x) * functionColorSlope[f];
}

bool integratePiece()
{
#if SHADING || GRADIENT_OPACITY
  lightSegment();
#endif
  vec3 othersStart = COMPONENTS_OF(segmentValuesStart);
  vec3 othersEnd = COMPONENTS_OF(segmentValuesEnd);

  // End of the piece: where the first function leaves its interval. A segment that begins outside
  // of an interval first moves the interval, by an empty piece.
  float leaves[NUMBER_OF_FUNCTIONS];
  int moves[NUMBER_OF_FUNCTIONS];
  bool inside = true;
  bool last = true;
  float reached = 1.0;
  for (int f = 0; f < NUMBER_OF_FUNCTIONS; ++f)
  {
    float start = scalarOf(f, segmentStart, othersStart);
    float end = scalarOf(f, segmentEnd, othersEnd);
    functionScalar[f] = segmentIsNew ? start : functionScalar[f];
    float now = functionScalar[f];
    vec4 range = functionRange[f];
    bool within = now >= range.x && now <= range.y;
    float target = within ? end : now;
    bool upward = target > range.y;
    bool downward = target < range.x;
    moves[f] = upward ? 1 : (downward ? -1 : 0);
    float place = clamp(((upward ? range.y : range.x) - start) / (end - start), segmentDone, 1.0);
    leaves[f] = upward || downward ? (within ? place : -1.0) : 2.0;
    inside = inside && within;
    last = last && !upward && !downward;
    reached = min(reached, max(leaves[f], segmentDone));
  }
  segmentIsNew = false;
  float pieceLength = (reached - segmentDone) * segmentLength;

  // Attenuation times length and emission at the ends of the piece.
  float fronts[NUMBER_OF_FUNCTIONS];
  float backs[NUMBER_OF_FUNCTIONS];
  vec2 density = vec2(0.0);
  for (int f = 0; f < NUMBER_OF_FUNCTIONS; ++f)
  {
    vec4 range = functionRange[f];
    float start = scalarOf(f, segmentStart, othersStart);
    float end = scalarOf(f, segmentEnd, othersEnd);
    bool leavesHere = leaves[f] >= 0.0 && leaves[f] <= reached;
    float ahead = clamp(reached < 1.0 ? mix(start, end, reached) : end, range.x, range.y);
    fronts[f] = functionScalar[f];
    backs[f] = inside ? (leavesHere ? (moves[f] > 0 ? range.y : range.x) : ahead) : fronts[f];
#if COMPONENT_MIXTURE == INDEPENDENT
    density += vec2(densityAt(f, fronts[f], pieceLength), densityAt(f, backs[f], pieceLength));
#endif
  }
#if COMPONENT_MIXTURE != INDEPENDENT
  density = vec2(densityAt(0, fronts[0], pieceLength), densityAt(0, backs[0], pieceLength));
#if COMPONENT_MIXTURE == COLOR_AND_OPACITY
  vec3 colorStart = colorAt(1, fronts[1]);
  vec3 colorEnd = colorAt(1, backs[1]);
#else
  vec3 colorStart = mix(othersStart, othersEnd, segmentDone);
  vec3 colorEnd = mix(othersStart, othersEnd, reached);
#endif
#endif
#if GRADIENT_OPACITY
  density *= mix(vec2(segmentOpacity.x), vec2(segmentOpacity.y), vec2(segmentDone, reached));
#endif

  float slope = density.y - density.x;
  float depth = 0.5 * (density.x + density.y);
  float part = 1.0;
  bool whole = depth <= LARGEST_GAUSS_DEPTH;
  if (!whole)
  {
    // part (density + part slope / 2) = LARGEST_GAUSS_DEPTH, the root without cancellation.
    part = min(1.0, 2.0 * LARGEST_GAUSS_DEPTH / (density.x +
      sqrt(max(0.0, density.x * density.x + 2.0 * LARGEST_GAUSS_DEPTH * slope))));
    depth = LARGEST_GAUSS_DEPTH;
  }
#if FADED
  float limit = fadedPart(segmentDone, reached);
  if (limit < part)
  {
    part = limit;
    depth = part * (density.x + 0.5 * part * slope);
    whole = false;
  }
#endif

  vec3 emitted = vec3(0.0);
  for (int q = 0; q < 3; ++q)
  {
    float at = part * (0.5 + float(q - 1) * GAUSS_PLACE);
#if COMPONENT_MIXTURE == INDEPENDENT
    vec3 here = vec3(0.0);
    for (int f = 0; f < NUMBER_OF_FUNCTIONS; ++f)
    {
      float scalar = mix(fronts[f], backs[f], at);
      here += densityAt(f, scalar, pieceLength) * colorAt(f, scalar);
    }
#if SHADING
    // Without a gradient no highlight is added, which the density would have to multiply.
    here = shade(here, mix(segmentDone, reached, at));
#endif
#else
    vec3 colorHere = mix(colorStart, colorEnd, at);
#if SHADING
    colorHere = shade(colorHere, mix(segmentDone, reached, at));
#endif
    vec3 here = (density.x + at * slope) * colorHere;
#endif
#if FADED
    here = faded(density.x + at * slope, here, mix(segmentDone, reached, at));
#endif
    emitted += GAUSS_WEIGHTS[q] * exp(-at * (density.x + 0.5 * at * slope)) * here;
  }
  color += transmittance * part * emitted;
  transmittance -= transmittance * absorbed(depth);

  segmentDone = whole ? reached : segmentDone + part * (reached - segmentDone);
  for (int f = 0; f < NUMBER_OF_FUNCTIONS; ++f)
  {
    functionScalar[f] = whole ? backs[f] : fronts[f] + part * (backs[f] - fronts[f]);
    if (whole && moves[f] != 0 && leaves[f] <= (inside ? reached : -1.0))
    {
      functionInterval[f] += moves[f];
      loadFunctionInterval(f);
    }
  }
  return whole && last;
}
