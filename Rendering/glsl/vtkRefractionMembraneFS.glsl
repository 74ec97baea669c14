//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Refraction/Membrane/Optics.h (reflectance)
//
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
uniform float relativeIndex;       // index of the interior relative to the exterior

// Reflectance of unpolarised light; c is the cosine of the angle of incidence. Eqs. 2.6 and 2.7 of
// the thesis.
float reflectance(float c)
{
  if (reflectanceModel == NO_REFLECTANCE)
  {
    return 0.0;
  }
  if (reflectanceModel == MIRROR)
  {
    return 1.0;
  }
  if (reflectanceModel == SCHLICK)
  {
    float r = (relativeIndex - 1.0) / (relativeIndex + 1.0);
    float x = 1.0 - c;
    return r * r + (1.0 - r * r) * x * x * x * x * x;
  }
  float g2 = relativeIndex * relativeIndex + c * c - 1.0;
  if (g2 <= 0.0)
  {
    return 1.0;
  }
  float g = sqrt(g2);
  float s = (g - c) / (g + c);
  float t = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * s * s * (1.0 + t * t);
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
  vec3 transmitted = behind.rgb + (1.0 - behind.a) * backdrop;
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
  gl_FragData[0] = vec4(mix(transmitted, mirrored, reflectance(cosine)), 1.0);
  gl_FragDepth = depth;
}
