//VTK::System::Dec

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the ray cast image, premultiplied RGBA, to the viewport.

in vec2 texCoord;

//VTK::Output::Dec

// Defines HAS_COLOR_BIAS where images are composited later. It is not the uniform that tells,
// because Mesa's rasterisers compute both branches of a condition.
//VTK::ColorBias::Dec

// Defines HAS_SAMPLES where a pixel of the framebuffer has several samples, of opaque geometry at
// several depths. The image has one colour per pixel, and one depth that its ray ends at.
//VTK::Samples::Dec

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

#ifdef HAS_SAMPLES
// Window depths that the rays end at.
uniform sampler2D depths;
// Whether the samples in front of the middle of a step of depths are drawn, or the others.
uniform bool drawsFront;

/** Largest sum of two differences of three depths in a row of a plane, each rounded to 24 bits. */
const float ROUNDING = 2.0 / 16777216.0;

/**
 * Colour of the samples to draw of a pixel at a step of depths, such as the outline of an object:
 * that of the pixel, or of the next one on the other side of the step. The test of depths leaves
 * out the samples of the other side.
 */
vec4 colorOfSamples(ivec2 pixel, vec4 colorOfPixel)
{
  ivec2 last = textureSize(depths, 0) - 1;
  float around[9];
  for (int i = 0; i < 9; ++i)
  {
    around[i] = texelFetch(depths, clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), last), 0).r;
  }
  float own = around[4];
  ivec2 beyond = pixel;
  float largest = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 to = ivec2(i % 3, i / 3) - 1;
    vec2 steps = vec2(around[i], around[8 - i]) - own;
    // Window depths of a plane are linear, so that these are opposite numbers.
    float bend = abs(steps.x + steps.y);
    // The window's border has no depths beyond it.
    ivec2 inside = min(pixel, last - pixel) - abs(to);
    bool isBent = bend > ROUNDING && min(inside.x, inside.y) >= 0;
    if (isBent && bend > 0.5 * abs(steps.x) && abs(steps.x) > abs(largest))
    {
      largest = steps.x;
      beyond = pixel + to;
    }
    if (isBent && bend > 0.5 * abs(steps.y) && abs(steps.y) > abs(largest))
    {
      largest = steps.y;
      beyond = pixel - to;
    }
  }
  if (largest == 0.0 && drawsFront)
  {
    discard;
  }
  gl_FragDepth = largest == 0.0 ? 0.0 : own + 0.5 * largest;
  bool isBeyond = largest != 0.0 && drawsFront == (largest < 0.0);
  return isBeyond ? texelFetch(image, beyond, 0) : colorOfPixel;
}
#endif

void main()
{
  vec4 color = texture(image, texCoord);
#ifdef HAS_SAMPLES
  color = colorOfSamples(ivec2(gl_FragCoord.xy - corner), color);
#endif
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
