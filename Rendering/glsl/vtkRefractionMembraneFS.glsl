//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Colour of a membrane's pixel: transmitted and reflected light.

//VTK::Environment::Dec

in vec2 texCoord;

//VTK::Output::Dec

uniform sampler2D refracted;       // premultiplied
uniform sampler2D mirroredScene;   // premultiplied, read if mirrorsScene
uniform bool mirrorsScene;
uniform sampler2D membraneNormal;  // view coordinates, towards the eye; 0 without a membrane
uniform sampler2D membraneDepth;   // window depth
#if HAS_ENVIRONMENT
uniform samplerCube environment;
uniform mat3 viewToWorld;
#endif
uniform mat4 clipToView;
uniform bool parallelView;
uniform vec3 background;
uniform vec3 backdrop;             // background, seen through the medium behind the membrane
uniform int reflectanceModel;      // NO_REFLECTANCE, SCHLICK, MIRROR, else Fresnel's

// Reflectances of light polarised across and within the plane of incidence, at the first interface;
// c is the cosine of the angle of incidence. Eqs. 2.6 and 2.7 of the thesis.
vec2 reflectance(float c)
{
  float n = relativeIndices[0];
  if (reflectanceModel == NO_REFLECTANCE)
  {
    return vec2(0.0);
  }
  if (reflectanceModel == MIRROR)
  {
    return vec2(1.0);
  }
  if (reflectanceModel == SCHLICK)
  {
    float r = (n - 1.0) / (n + 1.0);
    float x = 1.0 - c;
    return vec2(r * r + (1.0 - r * r) * x * x * x * x * x);
  }
  return fresnelReflectance(c);
}

// Reflectances of all interfaces.
vec2 reflectanceOfPlates(float c, vec2 first)
{
  bool isFirst = reflectanceModel == NO_REFLECTANCE || reflectanceModel == MIRROR;
  return isFirst ? first : 1.0 - transmittanceOfPlates(c, first);
}

void main()
{
  vec4 normal = texture(membraneNormal, texCoord);
  if (normal.a == 0.0)
  {
    discard;
  }
  float depth = texture(membraneDepth, texCoord).r;
  vec4 place = clipToView * vec4(2.0 * vec3(texCoord, depth) - 1.0, 1.0);
  vec3 sight = parallelView ? vec3(0.0, 0.0, -1.0) : normalize(place.xyz / place.w);
  vec3 n = normalize(normal.xyz);
  float cosine = clamp(-dot(n, sight), 0.0, 1.0);

  vec4 behind = texture(refracted, texCoord);
#if HAS_ENVIRONMENT
  vec3 mirrored = texture(environment, viewToWorld * reflect(sight, n)).rgb;
#else
  vec3 mirrored = background;
#endif
  if (mirrorsScene)
  {
    vec4 inFront = texture(mirroredScene, texCoord);
    mirrored = inFront.rgb + (1.0 - inFront.a) * mirrored;
  }
  // Objects carry the transmittance of the interfaces in front of them, without the first one.
  vec2 atFirst = reflectance(cosine);
  vec2 atAll = reflectanceOfPlates(cosine, atFirst);
  float first = 0.5 * (atFirst.x + atFirst.y);
  float all = 0.5 * (atAll.x + atAll.y);
  vec3 color = (1.0 - first) * behind.rgb + (1.0 - all) * (1.0 - behind.a) * backdrop;
  gl_FragData[0] = vec4(color + all * mirrored, 1.0);
  gl_FragDepth = depth;
}
