// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lighting of refracted geometry by its true positions and normals: see
// Rendering/Pass/TrueSpaceLighting.h. Points are in world coordinates relative to a point near the
// object (LocalPlaces.h), and directions in world coordinates.

const int MAXIMUM_OF_LIGHTS = 16;

uniform int trueLights;                           // number of lights
uniform vec4 trueLightPosition[MAXIMUM_OF_LIGHTS]; // or the direction to the light, with w = 0
uniform vec3 trueLightColor[MAXIMUM_OF_LIGHTS];
uniform vec4 trueLightCone[MAXIMUM_OF_LIGHTS];    // axis, cosine of the angle (-2: no cone)
uniform vec4 trueLightFalloff[MAXIMUM_OF_LIGHTS]; // for distance^0, 1, 2; exponent in the cone
uniform vec4 surfacePlane;   // height above the water: dot(xyz, point) + w
uniform float surfaceIndex;  // index of refraction behind the membrane relative to that in front
uniform vec3 trueEye;
uniform vec3 trueSpecular;
uniform float trueSpecularPower;
uniform bool lightIsFaded;   // by its way through the medium

// A ray from a light to a point.
struct LightRay
{
  vec3 toLight;     // unit vector at the point
  vec3 fromLight;   // unit vector at the light
  float path;       // length of a positional light's ray
  float inMedium;   // length of the part behind the membrane
  float flux;       // light across the ray, relative to a straight ray of the same length
  bool arrives;
};

// Height above the membrane of a light, or of the direction to it.
float heightOfLight(vec4 light)
{
  return dot(surfacePlane, light);
}

// Flux across a refracted beam as a share of the flux across the incident one, for the cosines of
// both angles: Fresnel's transmittance of unpolarised light, and the ratio of the beams' widths.
// Interfaces in between are parallel plates.
float transmittedFlux(float incident, float refracted)
{
  vec2 passed = transmittanceOfPlates(incident, fresnelReflectance(incident));
  return 0.5 * (passed.x + passed.y) * incident / max(refracted, 1.0e-6);
}

// Ray of a light at infinity in front of the membrane to a point behind it, by Snell's law.
LightRay refractDistantLight(vec3 toLight, float depth)
{
  LightRay ray;
  vec3 n = surfacePlane.xyz;
  vec3 across = (toLight - dot(toLight, n) * n) / surfaceIndex;
  float sine2 = dot(across, across);
  float cosine = sqrt(max(1.0 - sine2, 0.0));
  ray.arrives = sine2 < 1.0;
  ray.toLight = across + cosine * n;
  ray.fromLight = -toLight;
  ray.path = 0.0;
  ray.inMedium = cosine > 0.0 ? depth / cosine : 0.0;
  ray.flux = transmittedFlux(dot(toLight, n), cosine);
  return ray;
}

// Ray of a light at a point. The place x where the ray meets the membrane, from below the light
// towards the point below it, is the root of x / |(x, height)| - n (r - x) / |(r - x, depth)|,
// which grows with x: 24 bisections leave 2^-24 of r, the precision of floats. The distances of the
// two images of the light behind a plane (Coddington) tell how a thin beam spreads.
LightRay refractNearLight(vec3 light, float height, vec3 point, float depth)
{
  LightRay ray;
  vec3 n = surfacePlane.xyz;
  vec3 between = light - point;
  vec3 level = between - dot(between, n) * n;
  float r = length(level);
  vec3 along = r > 0.0 ? level / r : vec3(0.0);
  float low = 0.0;
  float high = r;
  for (int i = 0; i < 24; ++i)
  {
    float x = 0.5 * (low + high);
    bool beyond = x * length(vec2(r - x, depth)) > surfaceIndex * (r - x) * length(vec2(x, height));
    low = beyond ? low : x;
    high = beyond ? x : high;
  }
  float x = 0.5 * (low + high);
  float behind = length(vec2(r - x, depth));
  float before = length(vec2(x, height));
  ray.toLight = ((r - x) * along + depth * n) / behind;
  ray.fromLight = -(x * along + height * n) / before;
  ray.path = before + behind;
  ray.inMedium = behind;
  float incident = height / before;
  float refracted = depth / behind;
  float ratio = incident / refracted;
  float sagittal = before + behind / surfaceIndex;
  float tangential = before + behind / surfaceIndex * ratio * ratio;
  ray.flux =
    transmittedFlux(incident, refracted) * (ray.path / sagittal) * (ray.path / tangential);
  ray.arrives = true;
  return ray;
}

// Ray of a light to a point. Lights on the point's side of the membrane shine straight.
LightRay traceLight(vec4 light, vec3 point, bool isBehind)
{
  float depth = -dot(surfacePlane, vec4(point, 1.0));
  float height = heightOfLight(light);
  if (isBehind && depth > 0.0 && height > 0.0)
  {
    return light.w == 0.0 ? refractDistantLight(light.xyz, depth)
                          : refractNearLight(light.xyz, height, point, depth);
  }
  LightRay ray;
  vec3 between = light.xyz - light.w * point;
  float far = length(between);
  ray.toLight = between / far;
  ray.fromLight = -ray.toLight;
  ray.path = far;
  ray.inMedium = isBehind && light.w != 0.0 && height < 0.0 ? far : 0.0;
  ray.flux = 1.0;
  ray.arrives = far > 0.0;
  return ray;
}

#if HAS_LIT_TABLES
// Light through waves, from tables: Rendering/Pass/LitMesh.h.
uniform samplerBuffer litFaces;
uniform samplerBuffer litPlaces;       // vector and path, for one light after another
uniform isamplerBuffer litPrimitives;
uniform int litPlacesOfLight;
uniform int litNumberOfPrimitives;
uniform vec3 litOffset; // added to a point, it leads to one of the faces
uniform int trueLightTable[MAXIMUM_OF_LIGHTS]; // -1: none

// Places of a grid around a point, and their weights.
struct LitPlace
{
  bool isKnown;
  ivec3 places;
  vec3 weights;
};

// Number of a place in a grid of rows of n + 1, n, ... 1 places.
int numberInGrid(int n, int column, int row)
{
  return row * (n + 1) - row * (row - 1) / 2 + column;
}

// The place in the triangle, of those that the fragment's cell has, that contains the point.
LitPlace findLitPlace(vec3 position)
{
  vec3 point = position + litOffset;
  LitPlace place;
  int primitive = gl_PrimitiveID + PrimitiveIDOffset;
  int face = primitive < litNumberOfPrimitives ? texelFetch(litPrimitives, primitive).r : -1;
  place.isKnown = face >= 0;
  place.places = ivec3(0);
  place.weights = vec3(0.0);
  float best = -1.0e30;
  vec2 at = vec2(0.0);
  int n = 1;
  int first = 0;
  bool hasMore = place.isKnown;
  while (hasMore)
  {
    vec4 a = texelFetch(litFaces, 3 * face);
    vec4 b = texelFetch(litFaces, 3 * face + 1);
    vec4 c = texelFetch(litFaces, 3 * face + 2);
    vec3 u = b.xyz - a.xyz;
    vec3 v = c.xyz - a.xyz;
    vec3 w = point - a.xyz;
    float square = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
    vec2 own = vec2(dot(v, v) * dot(u, w) - dot(u, v) * dot(v, w),
      dot(u, u) * dot(v, w) - dot(u, v) * dot(u, w)) / square;
    // How far it is inside, and its height in sizes of the triangle: grids have cells of several
    // faces.
    float inside = min(min(own.x, own.y), 1.0 - own.x - own.y);
    float height = length(w - own.x * u - own.y * v) * inversesqrt(sqrt(max(square, 1.0e-37)));
    float quality = min(inside, 0.0) - height;
    if (quality > best)
    {
      best = quality;
      at = own;
      n = int(a.w);
      first = int(b.w);
    }
    hasMore = c.w > 0.0;
    ++face;
  }
  at = max(at, vec2(0.0));
  at /= max(at.x + at.y, 1.0);
  vec2 scaled = float(n) * at;
  int row = min(int(scaled.y), n - 1);
  int column = min(int(scaled.x), n - 1 - row);
  vec2 rest = scaled - vec2(column, row);
  bool isUpper = rest.x + rest.y > 1.0 && column + row + 1 < n;
  int corner = isUpper ? numberInGrid(n, column + 1, row + 1) : numberInGrid(n, column, row);
  int right = numberInGrid(n, column + 1, row);
  int above = numberInGrid(n, column, row + 1);
  place.places = first + (isUpper ? ivec3(corner, above, right) : ivec3(corner, right, above));
  rest = isUpper ? 1.0 - rest : rest;
  place.weights = vec3(1.0 - rest.x - rest.y, rest);
  return place;
}

// Mean ray of a light that waves refract.
LightRay readLight(LitPlace place, int table, vec4 light, vec3 point)
{
  vec4 read = vec4(0.0);
  for (int k = 0; k < 3; ++k)
  {
    read += place.weights[k] * texelFetch(litPlaces, table * litPlacesOfLight + place.places[k]);
  }
  LightRay ray;
  ray.flux = length(read.xyz);
  ray.arrives = ray.flux > 0.0;
  ray.toLight = ray.arrives ? read.xyz / ray.flux : surfacePlane.xyz;
  ray.inMedium = max(read.w, 0.0);
  ray.fromLight = -ray.toLight;
  ray.path = 0.0;
  if (light.w != 0.0)
  {
    // The tables have the light of a lamp relative to that where its rays meet the membrane.
    vec3 before = point + ray.inMedium * ray.toLight - light.xyz;
    float far = max(length(before), 1.0e-30);
    ray.fromLight = before / far;
    ray.path = far + ray.inMedium;
    ray.flux *= (ray.path / far) * (ray.path / far);
  }
  return ray;
}
#endif

#if HAS_SHADOWS
// True if an object is on the way of a light to a point: behind the membrane, and in front of it
// where the way bends.
bool isShadowed(vec4 light, LightRay ray, vec3 start, int spared)
{
  const float endless = 1.0e30;
  bool isNear = light.w != 0.0;
  if (ray.inMedium <= 0.0 || heightOfLight(light) <= 0.0)
  {
    return isHidden(start, ray.toLight, isNear ? length(light.xyz - start) : endless, spared);
  }
  return isHidden(start, ray.toLight, ray.inMedium, spared) ||
    isHidden(start + ray.inMedium * ray.toLight, -ray.fromLight,
      isNear ? ray.path - ray.inMedium : endless, 0);
}

// Where the ways to the light begin, and how many hits of the object's own triangles they spare.
struct ShadowStart
{
  vec3 point;
  int spared;
};

// The way begins on the light's side of the facet, beyond the error of heights above it. A point
// whose facet turns away from the light, but not its smooth normal, is at the edge of the lit side
// of a round body: its light leaves the body through one other facet. `away` has the facet's sine
// by that its direction may be off: the error of places over the distance of pixels.
ShadowStart startOfShadow(vec3 position, vec3 toViewer, vec3 toLight)
{
  vec3 right = dFdx(position);
  vec3 above = dFdy(position);
  vec3 facet = cross(right, above);
  float area = length(facet);
  vec3 unit = area > 0.0 ? facet / area : toLight;
  unit = dot(unit, toViewer) < 0.0 ? -unit : unit;
  float away = shadowRounding * max(length(right), length(above)) / max(area, 1.0e-37);
  float facing = dot(unit, toLight);
  ShadowStart start;
  start.point =
    position + (facing < 0.0 ? -1.0 : 1.0) * (shadowRounding + shadowTwist) * unit;
  start.spared = facing <= away ? 1 : 0;
  return start;
}
#endif

// Phong's model as VTK has it: light of all lights that the surface reflects to the eye.
vec3 lightInTrueSpace(
  vec3 ambient, vec3 diffuse, vec3 position, vec3 givenNormal, vec3 sightPoint, bool isBehind)
{
  vec3 facet = cross(dFdx(position), dFdy(position));
  vec3 toSight = sightPoint - position;
  vec3 toEye = trueEye - position;
  // Points in front of the membrane are seen straight. So are those on it, whose ray behind it is
  // shorter than the rounding errors of its ends, 2^-20 of the distance from the eye.
  bool isSeenStraight = !isBehind || dot(toSight, toSight) < dot(toEye, toEye) * 1.0e-12;
  vec3 toViewer = normalize(isSeenStraight ? toEye : toSight);
  bool isGiven = dot(givenNormal, givenNormal) > 0.25;
  vec3 normal = normalize(isGiven ? givenNormal : facet);
  // The side of the surface that is seen is that of its facet; a normal belongs to both sides.
  float side = isGiven ? dot(facet, toViewer) * dot(facet, normal) : dot(normal, toViewer);
  normal = side < 0.0 ? -normal : normal;

  vec3 color = ambient;
#if HAS_LIT_TABLES
  LitPlace place = findLitPlace(position);
#endif
  for (int i = 0; i < trueLights; ++i)
  {
#if HAS_LIT_TABLES
    bool isRead = place.isKnown && isBehind && trueLightTable[i] >= 0;
    LightRay ray = isRead ? readLight(place, trueLightTable[i], trueLightPosition[i], position)
                          : traceLight(trueLightPosition[i], position, isBehind);
#else
    LightRay ray = traceLight(trueLightPosition[i], position, isBehind);
#endif
    float strength = ray.arrives ? ray.flux : 0.0;
    if (trueLightPosition[i].w != 0.0)
    {
      strength /= dot(trueLightFalloff[i].xyz, vec3(1.0, ray.path, ray.path * ray.path));
      float inCone = dot(ray.fromLight, trueLightCone[i].xyz);
      bool hasCone = trueLightCone[i].w >= -1.0;
      strength *= hasCone && inCone < trueLightCone[i].w ? 0.0 : 1.0;
      strength *= hasCone ? pow(max(inCone, 0.0), trueLightFalloff[i].w) : 1.0;
    }
    vec3 arriving = strength * trueLightColor[i];
    arriving *= lightIsFaded ? seenThroughMedium(ray.inMedium) : vec3(1.0);
    float facing = dot(normal, ray.toLight);
#if HAS_SHADOWS
    ShadowStart start = startOfShadow(position, toViewer, ray.toLight);
    bool isDark =
      facing > 0.0 && isShadowed(trueLightPosition[i], ray, start.point, start.spared);
    facing = isDark ? 0.0 : facing;
#endif
    if (facing > 0.0)
    {
      float mirrored = max(dot(reflect(-ray.toLight, normal), toViewer), 0.0);
      color += arriving *
        (facing * diffuse + pow(max(mirrored, 1.0e-5), trueSpecularPower) * trueSpecular);
    }
  }
  return color;
}
