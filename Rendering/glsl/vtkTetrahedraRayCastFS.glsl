//VTK::System::Dec
#extension GL_ARB_gpu_shader5 : enable
#extension GL_ARB_shader_bit_encoding : enable

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Casts one ray per fragment through a tetrahedral mesh, in one pass.

in vec2 texCoord;

//VTK::Output::Dec

//VTK::TetrahedraOptions::Dec

//VTK::TetrahedraRays::Dec

//VTK::TetrahedraWalk::Dec

//VTK::TetrahedraLegs::Dec

//VTK::TetrahedraModel::Dec

uniform sampler2D opaqueDepth;

void main()
{
  int steps;
  int lost;
  // Fetched, not sampled, which takes llvmpipe much longer.
  ivec2 place = ivec2(texCoord * vec2(textureSize(opaqueDepth, 0)));
  gl_FragData[0] =
    castRay(gl_FragCoord.xy, texelFetch(opaqueDepth, place, 0).r, steps, lost);
  gl_FragData[1] = vec4(float(steps), float(lost), 0.0, 0.0);
}
