//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes one value to the viewport wherever the ray cast image is visible, for hardware selection.

in vec2 texCoord;

//VTK::Output::Dec

uniform sampler2D image;
uniform vec3 selectionValue;

void main()
{
  if (texture(image, texCoord).a <= 0.0)
  {
    discard;
  }
  gl_FragData[0] = vec4(selectionValue, 1.0);
}
