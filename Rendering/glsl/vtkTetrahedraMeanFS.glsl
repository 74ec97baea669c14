//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Adds a share of a ray cast image, premultiplied RGBA, to the mean of several.

in vec2 texCoord;

//VTK::Output::Dec

uniform sampler2D image;
uniform float weight;

void main()
{
  gl_FragData[0] = weight * texture(image, texCoord);
}
