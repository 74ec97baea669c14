// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A ray that collects colour from front to back, until its transmittance is negligible.

uniform float terminationTransmittance;

vec3 color;
float transmittance;

void startRay()
{
  color = vec3(0.0);
  transmittance = 1.0;
}

bool isRayDone()
{
  return transmittance <= terminationTransmittance;
}

vec4 finishRay()
{
  return vec4(color, 1.0 - transmittance);
}
