// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Composite blending: the density-emitter integral along the ray.

void startPart(float scalar)
{
  findInterval(scalar);
}

// 1 - psi, the mean over a piece of the absorption up to a place: the integral over [0, 1] of 1 -
// exp(-(a x + (t - a) x^2)), with density a at the front and optical depth t <= 1. A polynomial of
// degree 5, exact to first order, fitted to 3e-7 for all densities that are nowhere negative.
float absorbedOnAverage(float t, float a)
{
  float p0 = t * (0.3333333333 + t * (-0.0999792881 + t * (0.0236830118 +
    t * (-0.0043518064 + t * 0.0004903571))));
  float p1 = 0.1666666667 + t * (-0.0500173281 + t * (0.0119526605 +
    t * (-0.0023320093 + t * 0.0003181505)));
  float p2 = -0.0166512718 + t * (0.0047084626 + t * (-0.0008994605 + t * 0.0000935654));
  float p3 = 0.0011768438 + t * (-0.0003058993 + t * 0.0000410537);
  float p4 = -0.0000596959 + t * 0.0000104829;
  return p0 + a * (p1 + a * (p2 + a * (p3 + a * (p4 + a * 0.0000017222))));
}

// Integrates the next piece of the pending segment: up to the end of the segment, to that of the
// transfer function's interval or to an optical depth of 1. Returns true if the segment is done.
//
// Density-emitter integral with linear attenuation and colour: Moreland and Angel, "A Fast High
// Accuracy Volume Renderer for Unstructured Data" (2004). Their cf - cb zeta + (cb - cf) psi is
// written cf (1 - psi) + cb (psi - zeta), free of cancellation.
bool integratePiece()
{
#if SHADING || GRADIENT_OPACITY
  lightSegment();
#endif
  float to;
  float reached;
  int next;
  bool last = findPiece(to, reached, next);

  float pieceLength = (reached - segmentDone) * segmentLength;
  vec2 offsets = vec2(segmentScalar, to) - intervalRange.x;
  vec2 densities =
    clamp((intervalRange.z + offsets * intervalRange.w) * pieceLength, 0.0, LARGEST_DEPTH);
#if GRADIENT_OPACITY
  densities *= mix(vec2(segmentOpacity.x), vec2(segmentOpacity.y), vec2(segmentDone, reached));
#endif
  float slope = densities.y - densities.x;
  float depth = 0.5 * (densities.x + densities.y);
  float part = 1.0;
  bool whole = depth <= 1.0;
  if (!whole)
  {
    // part (density + part slope / 2) = 1, the root without cancellation.
    part = min(1.0, 2.0 / (densities.x + sqrt(max(0.0, densities.x * densities.x + 2.0 * slope))));
    depth = 1.0;
  }
  float gone = absorbed(depth);
  float front = absorbedOnAverage(depth, part * densities.x);
  vec3 colorStart = intervalColor + offsets.x * intervalColorSlope;
  vec3 colorChange = part * (offsets.y - offsets.x) * intervalColorSlope;
#if SHADING
  float partDone = mix(segmentDone, reached, part);
  colorChange = shade(colorStart + colorChange, partDone);
  colorStart = shade(colorStart, segmentDone);
  colorChange -= colorStart;
#endif
  color += transmittance * (colorStart * gone + colorChange * max(0.0, gone - front));
  transmittance -= transmittance * gone;

  segmentDone = whole ? reached : segmentDone + part * (reached - segmentDone);
  segmentScalar = whole ? to : segmentScalar + part * (to - segmentScalar);
  if (whole && !last)
  {
    interval = next;
    loadInterval();
  }
  return whole && last;
}
