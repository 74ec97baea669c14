// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/CompositeModel.h (integral of a medium)
//
// Composite blending: the density-emitter integral along the ray.

void startPart(float scalar)
{
  findInterval(scalar);
}

// 1 - psi, the mean over a piece of the absorption up to a place, with density a at the front and
// optical depth t <= 1: see AbsorptionFit in Module/Volume/Optics/MediumConstants.h.
float absorbedOnAverage(float t, float a)
{
  float p0 = t * MEAN_ABSORBED_0(t);
  float p1 = MEAN_ABSORBED_1(t);
  float p2 = MEAN_ABSORBED_2(t);
  float p3 = MEAN_ABSORBED_3(t);
  float p4 = MEAN_ABSORBED_4(t);
  // By pairs: a chain of six terms would delay all that follows.
  float a2 = a * a;
  return (p0 + a * p1) + a2 * ((p2 + a * p3) + a2 * (p4 + a * MEAN_ABSORBED_5(t)));
}

#if FADED
#define LARGEST_PIECE_DEPTH LARGEST_GAUSS_DEPTH
#else
#define LARGEST_PIECE_DEPTH 1.0
#endif

// Integrates the next piece of the pending segment: up to the end of the segment, to that of the
// transfer function's interval or to an optical depth of LARGEST_PIECE_DEPTH. Returns true if the
// segment is done.
//
// Density-emitter integral with linear attenuation and colour: Moreland and Angel, "A Fast High
// Accuracy Volume Renderer for Unstructured Data" (2004). Their cf - cb zeta + (cb - cf) psi is
// written cf (1 - psi) + cb (psi - zeta), free of cancellation. With a medium in front, Gauss' rule
// of three points.
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
  bool whole = depth <= LARGEST_PIECE_DEPTH;
  if (!whole)
  {
    // part (density + part slope / 2) = D, the root without cancellation.
    part = min(1.0, 2.0 * LARGEST_PIECE_DEPTH / (densities.x +
      sqrt(max(0.0, densities.x * densities.x + 2.0 * LARGEST_PIECE_DEPTH * slope))));
    depth = LARGEST_PIECE_DEPTH;
  }
#if FADED
  float limit = fadedPart(segmentDone, reached);
  if (limit < part)
  {
    part = limit;
    depth = part * (densities.x + 0.5 * part * slope);
    whole = false;
  }
  for (int q = 0; q < 3; ++q)
  {
    float at = part * (0.5 + float(q - 1) * GAUSS_PLACE);
    float done = mix(segmentDone, reached, at);
    vec3 emitted = intervalColor + mix(offsets.x, offsets.y, at) * intervalColorSlope;
#if SHADING
    emitted = shade(emitted, done);
#endif
    float weight = q == 1 ? MIDDLE_GAUSS_WEIGHT : OUTER_GAUSS_WEIGHT;
    color += transmittance * part * weight * (densities.x + at * slope) *
      exp(-at * (densities.x + 0.5 * at * slope)) * faded(1.0, emitted, done);
  }
  transmittance -= transmittance * absorbed(depth);
#else
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
#endif

  segmentDone = whole ? reached : segmentDone + part * (reached - segmentDone);
  segmentScalar = whole ? to : segmentScalar + part * (to - segmentScalar);
  if (whole && !last)
  {
    interval = next;
    loadInterval();
  }
  return whole && last;
}
