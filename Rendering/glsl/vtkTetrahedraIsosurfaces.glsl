// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/IsosurfaceModel.h (isovalues next to a scalar)
// Twin: Module/Volume/Packet/Models/PacketSurfaces.cxx (surfaces that a segment meets)
//
// Isosurfaces, intersected exactly where the scalar, linear along a segment, passes an isovalue. A
// scalar equal to an isovalue counts as above it: a surface through a face is met once, and a
// surface that a ray only touches is not met. Scalars of cells pass isovalues on the faces where
// they jump.

uniform samplerBuffer surfaces;      // ascending, 2 texels each: (isovalue, opacity), colour
uniform int numberOfSurfaces;

const float BEYOND = 3.0e+38;

int surfacesBelow;   // number of isovalues not above the scalar
vec2 surfaceRange;   // isovalues next to the scalar
bool isRangeKnown;   // true: the range is that of the last segment's end

void loadSurfaceRange()
{
  surfaceRange.x = surfacesBelow > 0 ? texelFetch(surfaces, 2 * surfacesBelow - 2).x : -BEYOND;
  surfaceRange.y =
    surfacesBelow < numberOfSurfaces ? texelFetch(surfaces, 2 * surfacesBelow).x : BEYOND;
}

void startPart(float scalar)
{
  int low = 0;
  int high = numberOfSurfaces;
  while (low < high)
  {
    int middle = (low + high) / 2;
    bool above = texelFetch(surfaces, 2 * middle).x > scalar;
    low = above ? low : middle + 1;
    high = above ? middle : high;
  }
  surfacesBelow = low;
  loadSurfaceRange();
  isRangeKnown = false;
}

#if VERTEX_LIGHT && CELL_SCALARS
// Light before a face that is a surface: that of the cell which the ray has left by it.
vec3 lightBefore(float isovalue, bool fromBelow)
{
  int before = cellValue(CELL_SIZE * cell + FIRST_LINK + face);
  return texelFetch(vertexLight, before < 0 ? cell : before >> 2).xyz;
}
#elif VERTEX_LIGHT
// Light at a point of a surface, on the ray: interpolated between those vertices of the cell that
// lie on the side from which the ray comes. The surface itself may hide the light from the others.
// Their weights are in the ratio of the volumes of the other three and the point, in the space of
// the place relative to the ray and of the scalar.
vec3 lightBefore(float isovalue, bool fromBelow)
{
  ivec4 numbers = ivec4(corners, dropped);
  RayVertex vertices[4] = RayVertex[4](a, b, c, droppedVertex);
  vec3 place[4];
  for (int k = 0; k < 4; ++k)
  {
    place[k] =
      vec3(placeOf(vertices[k]) * (1.0 / 65536.0), vertexScalar(vertices[k]) - isovalue);
  }
  vec3 last = cross(place[2], place[3]);
  vec3 first = cross(place[0], place[1]);
  vec4 volumes = abs(vec4(
    dot(place[1], last), dot(place[0], last), dot(place[3], first), dot(place[2], first)));
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    // In a cell without volume the vertices count alike.
    float weight = (place[k].z < 0.0) == fromBelow ? max(volumes[k], 1.0e-30) : 0.0;
    sum += weight * texelFetch(vertexLight, numbers[k]).xyz;
    total += weight;
  }
  return total > 0.0 ? sum / total : vec3(1.0);
}
#endif

// Adds a surface at a fraction of the pending segment, met from below or above its isovalue.
void addSurface(int index, float at, bool fromBelow)
{
  float alpha = texelFetch(surfaces, 2 * index).y;
  vec3 emitted = texelFetch(surfaces, 2 * index + 1).rgb;
#if SHADING
#if CELL_SCALARS
  vec3 gradient = faceNormal();
#elif VERTEX_GRADIENTS
  vec3 gradient = mix(segmentValuesStart, segmentValuesEnd, at);
#else
  vec3 gradient = cellGradient(cell);
#endif
#if VERTEX_LIGHT
  lightReached = lightBefore(texelFetch(surfaces, 2 * index).x, fromBelow);
#endif
  vec3 reflected;
  vec3 highlight;
  light(gradient, mix(segmentStartDepth, segmentEndDepth, at), reflected, highlight);
  emitted = emitted * reflected + highlight;
#endif
#if FADED
  emitted = faded(1.0, emitted, at);
#endif
  color += transmittance * alpha * emitted;
  transmittance -= transmittance * alpha;
}

// Adds one surface per turn, front to back. The scalar passes all values between the ends of
// successive segments in a segment without length, which is skipped: where a segment begins outside
// of the range, surfaces are added at its start, unless it is the first one of its part.
bool integratePiece()
{
  // After the range contains the segment's start, segmentDone is 1.
  bool inside = segmentDone > 0.0 ||
    (segmentStart >= surfaceRange.x && segmentStart < surfaceRange.y);
  float target = inside ? segmentEnd : segmentStart;
  bool upward = target >= surfaceRange.y;
  bool downward = target < surfaceRange.x;
  isRangeKnown = isRangeKnown || inside;
  segmentDone = inside ? 1.0 : 0.0;
  if (upward || downward)
  {
    if (isRangeKnown)
    {
#if CELL_SCALARS
      float at = 0.0;
#else
      float isovalue = upward ? surfaceRange.y : surfaceRange.x;
      float at =
        inside ? clamp((isovalue - segmentStart) / (segmentEnd - segmentStart), 0.0, 1.0) : 0.0;
#endif
      addSurface(upward ? surfacesBelow : surfacesBelow - 1, at, upward);
    }
    surfacesBelow += upward ? 1 : -1;
    loadSurfaceRange();
  }
  return inside && !upward && !downward;
}
