//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the ray cast image, premultiplied RGBA, to the viewport.

in vec2 texCoord;

//VTK::Output::Dec

// Defines HAS_COLOR_BIAS where images are composited later. It is not the uniform that tells,
// because Mesa's rasterisers compute both branches of a condition.
//VTK::ColorBias::Dec

uniform sampler2D image;
// Contents of a framebuffer of 8 bits from the viewport's corner on, in place of blending.
uniform sampler2D under;
uniform vec2 corner;
uniform bool hasUnder;
// Bias of an image that is composited later, in steps of 1/255.
uniform float colorBias;

const float STEPS = 255.0;

// Rounds to whole steps, up or down by the bias, such that no colour exceeds the opacity: the sum
// of whole steps front + back (255 - opacity) / 255 is then at most 255. Rounding of the opacity
// removes between none and all of one step of a colour behind; half of that is compensated: this
// leaves an error of half a step instead of a whole one for the colour, which is unknown here.
vec4 roundForCompositing(vec4 exact)
{
  vec4 inSteps = STEPS * exact;
  float opacity = min(floor(inSteps.a + colorBias + 0.5), STEPS);
  float behind = 0.5 * (opacity - inSteps.a);
  vec3 color = floor(inSteps.rgb + colorBias + behind + 0.5);
  return vec4(clamp(color, 0.0, opacity), opacity) / STEPS;
}

// As above, for framebuffers that blend and round: a monotonic rounding keeps the order of colour
// and opacity.
vec4 biasForCompositing(vec4 exact)
{
  float opacity = min(exact.a + colorBias / STEPS, 1.0);
  return vec4(min(exact.rgb + colorBias / STEPS, opacity), opacity);
}

void main()
{
  vec4 color = texture(image, texCoord);
#ifdef HAS_COLOR_BIAS
  bool biased = color.a > 0.0;
#else
  const bool biased = false;
#endif
  if (hasUnder)
  {
    color += (1.0 - color.a) * texelFetch(under, ivec2(gl_FragCoord.xy - corner), 0);
    // Rounded here: an NVIDIA H200 is up to 0.56 steps off when it rounds a float to 8 bits.
    color = biased ? roundForCompositing(color) : floor(STEPS * color + 0.5) / STEPS;
  }
  else
  {
    color = biased ? biasForCompositing(color) : color;
  }
  gl_FragData[0] = color;
}
