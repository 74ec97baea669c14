// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Refraction/Membrane/Optics.h (PlateTransmittance)
//
// Fresnel's equations for interfaces one behind another.

uniform int interfaces; // number of interfaces, at least 1
// Index of refraction behind each interface, relative to the medium in front of the first one.
uniform float relativeIndices[MAXIMUM_OF_INTERFACES];

// Reflectances of light polarised across and within the plane of incidence, at the first interface;
// c is the cosine of the angle of incidence. Eq. 2.6 of the thesis.
vec2 fresnelReflectance(float c)
{
  float n = relativeIndices[0];
  float g2 = n * n + c * c - 1.0;
  if (g2 <= 0.0)
  {
    return vec2(1.0);
  }
  float g = sqrt(g2);
  vec2 r = vec2((g - c) / (g + c), (n * n * c - g) / (n * n * c + g));
  return r * r;
}

// Transmittances of all interfaces, with the light that is reflected between them, as parallel
// plates have it, for the reflectances of the first one.
vec2 transmittanceOfPlates(float c, vec2 first)
{
  vec2 passed = 1.0 - first;
  vec2 back = first;
  float sine2 = 1.0 - c * c;
  for (int i = 1; i < interfaces; ++i)
  {
    // Cosines in front of and behind the interface, each times the index of its medium.
    float before = sqrt(max(relativeIndices[i - 1] * relativeIndices[i - 1] - sine2, 0.0));
    float square = relativeIndices[i] * relativeIndices[i] - sine2;
    if (square <= 0.0 || before <= 0.0)
    {
      return vec2(0.0);
    }
    float behind = sqrt(square);
    float ratio = relativeIndices[i] / relativeIndices[i - 1];
    vec2 r = vec2((before - behind) / (before + behind),
      (ratio * ratio * before - behind) / (ratio * ratio * before + behind));
    r *= r;
    vec2 once = 1.0 - back * r;
    passed *= (1.0 - r) / once;
    back = r + (1.0 - r) * (1.0 - r) * back / once;
  }
  return passed;
}
