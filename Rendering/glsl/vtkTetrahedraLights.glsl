// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/PacketLights.h (lights)
// Twin: Module/Volume/Optics/SurfaceLighting.cxx (lights)
//
// Gradients and lights. Positions and directions are in the frame of the view (x, y, depth), in
// which lengths are world lengths up to a factor.

// Normalised model coordinates in units of TetrahedralMesh::PositionUnit; bits of the normalised
// scalar.
uniform isamplerBuffer modelVertices;
uniform mat3 gradientToFrame;        // from normalised model coordinates
uniform float gradientMagnitude;     // per length in the frame: scalar per world length, normalised
uniform int firstGradientInterval;   // gradient opacity follows the intervals of the scalar
uniform int numberOfGradientIntervals;
uniform float ambient;
uniform float diffuse;
uniform float specular;
uniform float specularPower;
#if NUMBER_OF_LIGHTS > 0
uniform vec4 lightPosition[NUMBER_OF_LIGHTS];    // or the direction to the light, with w = 0
uniform vec3 lightDiffuse[NUMBER_OF_LIGHTS];
uniform vec3 lightSpecular[NUMBER_OF_LIGHTS];
uniform vec4 lightCone[NUMBER_OF_LIGHTS];        // axis, cosine of the angle (-2: no cone)
uniform vec4 lightFalloff[NUMBER_OF_LIGHTS];     // for distance^0, 1, 2; exponent in the cone
#endif

#if VERTEX_LIGHT
// Global illumination, see SurfaceLighting: the light whose transmittance is known apart, the share
// of light that is scattered, and its anisotropy; and the numbers of VertexLight at the place that
// is lit.
uniform int brightestLight;
uniform float scattering;
uniform float anisotropy;
vec3 lightReached;

// Henyey and Greenstein's phase function, 1 in the mean; for the cosine of the turn of light.
float phase(float cosine)
{
  float square =
    max(1.0 + anisotropy * anisotropy - 2.0 * anisotropy * cosine, SMALLEST_TURN);
  return (1.0 - anisotropy * anisotropy) / (square * sqrt(square));
}
#endif

#if CELL_GRADIENTS
uniform samplerBuffer cellGradients;

// Gradient of the scalar in a cell; 0 in a cell without volume.
vec3 cellGradient(int index)
{
  return texelFetch(cellGradients, index).xyz;
}
#endif

#if CELL_SCALARS && SHADING
// Difference of two vertices, in units of MODEL_UNIT: exact up to rounding to float.
vec4 fromVertex(ivec4 from, int vertex)
{
  ivec4 p = texelFetch(modelVertices, vertex);
  return vec4(vec3(p.xyz - from.xyz), intBitsToFloat(p.w) - intBitsToFloat(from.w));
}

// Normal of the face by which the ray entered the cell that it is leaving: of all vertices but the
// apex.
vec3 faceNormal()
{
  ivec3 entered = ivec3(corners.x == apex ? dropped : corners.x,
    corners.y == apex ? dropped : corners.y, corners.z == apex ? dropped : corners.z);
  ivec4 p = texelFetch(modelVertices, entered.x);
  return cross(fromVertex(p, entered.y).xyz, fromVertex(p, entered.z).xyz);
}
#endif

#if GRADIENT_OPACITY
// Factor of the attenuation.
float gradientOpacity(vec3 gradient)
{
  float size = gradientMagnitude * length(gradientToFrame * gradient);
  int low = firstGradientInterval;
  int high = firstGradientInterval + numberOfGradientIntervals - 1;
  while (low < high)
  {
    int middle = (low + high) / 2;
    bool above = texelFetch(intervals, 3 * middle).y < size;
    low = above ? middle + 1 : low;
    high = above ? high : middle;
  }
  vec4 range = texelFetch(intervals, 3 * low);
  return max(0.0, range.z + (size - range.x) * range.w);
}
#endif

// Phong's model, two-sided: the normal is the gradient, turned to the viewer. Returns the factor of
// the emitted colour, and the light that is added to it, at a depth on the ray.
void light(vec3 gradient, float depth, out vec3 reflected, out vec3 highlight)
{
#if VERTEX_LIGHT
  reflected = vec3(ambient * lightReached.x);
#else
  reflected = vec3(ambient);
#endif
  highlight = vec3(0.0);
  vec3 normal = gradientToFrame * gradient;
  float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  bool isFacing = largest > 0.0;
#if VERTEX_LIGHT
  vec3 scattered = reflected;
#else
  if (!isFacing)
  {
    return;
  }
#endif
  normal = isFacing ? normalize(normal / largest) : vec3(0.0);
  vec3 toEye = -normalize(rayAlong);
  normal = dot(normal, toEye) < 0.0 ? -normal : normal;
#if NUMBER_OF_LIGHTS > 0
  vec3 place = rayPlace + depth * rayAlong;
  for (int i = 0; i < NUMBER_OF_LIGHTS; ++i)
  {
    vec3 toLight = lightPosition[i].xyz - lightPosition[i].w * place;
    float distance = length(toLight);
    toLight /= distance;
    float falloff = dot(lightFalloff[i].xyz, vec3(1.0, distance, distance * distance));
    float strength = min(1.0 / falloff, LARGEST_LIGHT_STRENGTH);
    float inCone = -dot(toLight, lightCone[i].xyz);
    bool lit = inCone >= lightCone[i].w;
    strength *= lightCone[i].w >= -1.0 && lightFalloff[i].w != 0.0
      ? pow(clamp(inCone, 0.0, 1.0), lightFalloff[i].w)
      : 1.0;
#if VERTEX_LIGHT
    strength *= i == brightestLight ? lightReached.y : lightReached.z;
    scattered += lit ? strength * diffuse * phase(-dot(toLight, toEye)) * lightDiffuse[i]
                     : vec3(0.0);
#endif
    float facing = min(dot(normal, toLight), 1.0);
    if (lit && facing > 0.0)
    {
      float glance = min(dot(2.0 * facing * normal - toLight, toEye), 1.0);
      reflected += strength * diffuse * facing * lightDiffuse[i];
      highlight +=
        glance > 0.0 ? strength * specular * pow(glance, specularPower) * lightSpecular[i]
                     : vec3(0.0);
    }
  }
#endif
#if VERTEX_LIGHT
  reflected = mix(reflected, scattered, scattering);
  highlight *= 1.0 - scattering;
#endif
}
