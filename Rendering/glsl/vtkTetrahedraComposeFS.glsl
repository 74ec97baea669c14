//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Puts the ray cast image, premultiplied RGBA, into the viewport.

in vec2 texCoord;

//VTK::Output::Dec

uniform sampler2D image;

void main()
{
  gl_FragData[0] = texture(image, texCoord);
}
