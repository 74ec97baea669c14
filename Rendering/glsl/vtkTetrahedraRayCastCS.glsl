#version 430

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Casts one ray per invocation through a tetrahedral mesh: the twin of the fragment shader
// (vtkTetrahedraRayCastFS), made of the same functions.

// As many as a device runs in step: registers of a larger group are free only after its longest ray
// (an NVIDIA H200 casts rays through 3 million cells 1.7 times faster so than with 8 x 8).
layout(local_size_x = 8, local_size_y = 4) in;

layout(rgba32f, binding = 0) uniform writeonly image2D rayImage;
layout(rg32f, binding = 1) uniform writeonly image2D statisticsImage;

//VTK::TetrahedraOptions::Dec

//VTK::TetrahedraRays::Dec

//VTK::TetrahedraWalk::Dec

//VTK::TetrahedraLegs::Dec

//VTK::TetrahedraModel::Dec

uniform sampler2D opaqueDepth;

void main()
{
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(rayImage);
  if (any(greaterThanEqual(pixel, size)))
  {
    return;
  }
  vec2 center = vec2(pixel) + vec2(0.5);
  int steps;
  int lost;
  float opaque = textureLod(opaqueDepth, center / vec2(size), 0.0).r;
  imageStore(rayImage, pixel, castRay(center, opaque, steps, lost));
  imageStore(statisticsImage, pixel, vec4(float(steps), float(lost), 0.0, 0.0));
}
