// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangles that hide light from a point, in a tree of boxes: Rendering/Pass/ShadowCasters.h.

uniform samplerBuffer shadowNodes;
uniform samplerBuffer shadowTriangles;
uniform int shadowNumberOfNodes;
uniform int shadowObject;     // number of the object that is lit
uniform vec3 shadowOffset;    // added to its places, it leads to those of the tables
uniform float shadowRounding; // bound for the error of a height above a triangle's plane
uniform float shadowTwist;    // how far the object may be off its triangles

// True if the way of a length from a point meets a triangle within its edges.
bool meetsTriangle(int triangle, vec3 start, vec3 along, float most, out float number)
{
  vec4 first = texelFetch(shadowTriangles, 4 * triangle);
  vec4 plane = texelFetch(shadowTriangles, 4 * triangle + 3);
  number = first.w;
  float rate = dot(plane.xyz, along);
  float way = -(dot(plane.xyz, start) + plane.w) / rate;
  vec3 a = first.xyz - start;
  vec3 b = texelFetch(shadowTriangles, 4 * triangle + 1).xyz - start;
  vec3 c = texelFetch(shadowTriangles, 4 * triangle + 2).xyz - start;
  // On which side of each edge the way passes: triangles that share one get opposite numbers.
  vec3 sides =
    vec3(dot(along, cross(b, c)), dot(along, cross(c, a)), dot(along, cross(a, b)));
  bool isInside =
    all(greaterThanEqual(sides, vec3(0.0))) || all(lessThanEqual(sides, vec3(0.0)));
  return rate != 0.0 && isInside && way > 0.0 && way < most;
}

// True if a triangle is on the way of a length from a point. So many hits of the object's own
// triangles do not count.
bool isHidden(vec3 place, vec3 along, float most, int spared)
{
  vec3 start = place + shadowOffset;
  // A way across an axis is turned by 2^-60, which moves no place by a rounding.
  const float least = 8.7e-19;
  vec3 inverse = 1.0 / mix(along, vec3(least), lessThan(abs(along), vec3(least)));
  // Boxes are larger by the error of places.
  vec3 fromLow = start + shadowRounding;
  vec3 fromHigh = start - shadowRounding;
  int node = 0;
  bool hides = false;
  while (node < shadowNumberOfNodes && !hides)
  {
    vec4 low = texelFetch(shadowNodes, 2 * node);
    vec4 high = texelFetch(shadowNodes, 2 * node + 1);
    vec3 toLow = (low.xyz - fromLow) * inverse;
    vec3 toHigh = (high.xyz - fromHigh) * inverse;
    vec3 near = min(toLow, toHigh);
    vec3 far = max(toLow, toHigh);
    bool isMet = max(max(near.x, near.y), max(near.z, 0.0)) <=
      min(min(far.x, far.y), min(far.z, most));
    int triangle = int(high.w);
    float number = 0.0;
    if (isMet && triangle >= 0 && meetsTriangle(triangle, start, along, most, number))
    {
      bool isSpared = spared > 0 && int(number) == shadowObject;
      spared -= isSpared ? 1 : 0;
      hides = !isSpared;
    }
    node = isMet ? node + 1 : int(low.w);
  }
  return hides;
}
