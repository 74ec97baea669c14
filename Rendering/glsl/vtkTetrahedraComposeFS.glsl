//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Puts the ray cast image, premultiplied RGBA, into the viewport.

in vec2 texCoord;

//VTK::Output::Dec

uniform sampler2D image;
// What is there, from the viewport's corner on, if it is not blended with by the framebuffer.
uniform sampler2D under;
uniform vec2 corner;
uniform bool hasUnder;
// Added to the colour of what is not transparent.
uniform float colorBias;

void main()
{
  vec4 color = texture(image, texCoord);
  color.rgb += color.a > 0.0 ? colorBias : 0.0;
  if (hasUnder)
  {
    color += (1.0 - color.a) * texelFetch(under, ivec2(gl_FragCoord.xy - corner), 0);
  }
  gl_FragData[0] = color;
}
