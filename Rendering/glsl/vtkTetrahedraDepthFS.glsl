//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes depths of the volume to the viewport's depth buffer; pixels without one hold 2.

in vec2 texCoord;

//VTK::Output::Dec

uniform sampler2D depths;

void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
  gl_FragData[0] = vec4(0.0);
}
