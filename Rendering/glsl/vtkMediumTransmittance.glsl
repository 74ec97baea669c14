// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Optics/RefractionMedium.cxx (share of the light)
//
// The medium behind a membrane: see Rendering/Property/MediumUniforms.h.

uniform bool mediumIsLinear;
uniform vec3 mediumAttenuation;
uniform vec2 mediumRange;
uniform vec3 mediumColor;

// Share of the light per channel that reaches the sight point from a distance.
vec3 seenThroughMedium(float distance)
{
  if (mediumIsLinear)
  {
    float width = mediumRange.y - mediumRange.x;
    return vec3(width > 0.0 ? clamp((mediumRange.y - distance) / width, 0.0, 1.0)
                            : (distance < mediumRange.y ? 1.0 : 0.0));
  }
  return exp(-mediumAttenuation * distance);
}

// A colour seen from a distance, with the light that the medium scatters towards the eye.
vec3 inMedium(vec3 color, float distance)
{
  return mix(mediumColor, color, seenThroughMedium(distance));
}
