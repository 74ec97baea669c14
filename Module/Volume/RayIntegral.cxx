// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/RayIntegral.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** Optical depth of a piece beyond which nothing can be told apart; keeps infinities out. */
constexpr float LargestDepth = 1.0e+30f;
/** Normalised scalars are in [-1, 1]: a larger change is that of a vertex without a scalar. */
constexpr float LargestChange = 4.0f;

/** 1 - exp(-x) for x in [0, 1], to 2e-9: x times a Chebyshev interpolant of (1 - exp(-x)) / x. */
float Absorbed(float x)
{
  return x *
    (0.99999999793357f +
      x *
        (-0.49999979725212f +
          x *
            (0.16666340311502f +
              x *
                (-0.04164684931339f +
                  x * (0.00827550484353f + x * (-0.00130077495785f + x * 0.00012907631016f))))));
}

/**
 * 1 - psi, the mean over a piece of what has been absorbed up to a place: the integral over [0, 1]
 * of 1 - exp(-(a x + (t - a) x^2)), with density a at the front and optical depth t <= 1. A
 * polynomial of degree 5, exact to first order, fitted to 3e-7 for all densities that are nowhere
 * negative.
 */
float AbsorbedOnAverage(float t, float a)
{
  const float p0 = t *
    (0.3333333333f +
      t * (-0.0999792881f + t * (0.0236830118f + t * (-0.0043518064f + t * 0.0004903571f))));
  const float p1 = 0.1666666667f +
    t * (-0.0500173281f + t * (0.0119526605f + t * (-0.0023320093f + t * 0.0003181505f)));
  const float p2 = -0.0166512718f + t * (0.0047084626f + t * (-0.0008994605f + t * 0.0000935654f));
  const float p3 = 0.0011768438f + t * (-0.0003058993f + t * 0.0000410537f);
  const float p4 = -0.0000596959f + t * 0.0000104829f;
  return p0 + a * (p1 + a * (p2 + a * (p3 + a * (p4 + a * 0.0000017222f))));
}

}

//------------------------------------------------------------------------------
RayIntegral::RayIntegral(
  const std::vector<TransferFunctionInterval>& intervals, float terminationTransmittance)
  : Intervals(intervals)
  , TerminationTransmittance(terminationTransmittance)
{
}

//------------------------------------------------------------------------------
void RayIntegral::FindInterval(float scalar)
{
  const TransferFunctionInterval& current = this->Intervals[this->Current];
  if (scalar >= current.Lower && scalar <= current.Upper)
  {
    return;
  }
  const auto found = std::lower_bound(this->Intervals.begin(), this->Intervals.end(), scalar,
    [](const TransferFunctionInterval& interval, float s) { return interval.Upper < s; });
  this->Current = std::min<std::size_t>(
    std::distance(this->Intervals.begin(), found), this->Intervals.size() - 1);
}

//------------------------------------------------------------------------------
void RayIntegral::AddSegment(float scalar0, float scalar1, float length)
{
  const float change = scalar1 - scalar0;
  if (!(std::abs(change) <= LargestChange) || !(length > 0.0f))
  {
    return;
  }
  this->FindInterval(scalar0);
  float scalar = scalar0;
  float done = 0.0f;
  while (!this->IsTerminated())
  {
    const TransferFunctionInterval& interval = this->Intervals[this->Current];
    const bool upward = scalar1 > interval.Upper;
    const bool downward = scalar1 < interval.Lower;
    const bool last = !upward && !downward;
    const float to = upward ? interval.Upper : (downward ? interval.Lower : scalar1);
    const float reached = last ? 1.0f : std::min(std::max((to - scalar0) / change, done), 1.0f);
    float part = 0.0f;
    for (float at = 0.0f; at < 1.0f && !this->IsTerminated(); at += (1.0f - at) * part)
    {
      const float from = scalar + at * (to - scalar);
      part = this->AddPart(interval, from, to, (1.0f - at) * (reached - done) * length);
    }
    if (last)
    {
      return;
    }
    scalar = to;
    done = reached;
    this->Current += upward ? 1 : -1;
  }
}

//------------------------------------------------------------------------------
float RayIntegral::AddPart(
  const TransferFunctionInterval& interval, float from, float to, float length)
{
  const float offset0 = from - interval.Lower;
  const float offset1 = to - interval.Lower;
  const auto densityAt = [&interval, length](float offset)
  {
    const float density = (interval.Attenuation + offset * interval.AttenuationSlope) * length;
    return std::min(std::max(density, 0.0f), LargestDepth);
  };
  const float density = densityAt(offset0);
  const float slope = densityAt(offset1) - density;
  float part = 1.0f;
  float depth = density + 0.5f * slope;
  if (depth > 1.0f)
  {
    // part (density + part slope / 2) = 1, the root without cancellation.
    const float root = std::sqrt(std::max(0.0f, density * density + 2.0f * slope));
    part = std::min(1.0f, 2.0f / (density + root));
    depth = 1.0f;
  }
  const float gone = Absorbed(depth);
  const float front = AbsorbedOnAverage(depth, part * density);
  const glm::vec3 colorFront = interval.Color + offset0 * interval.ColorSlope;
  const glm::vec3 colorChange = part * (offset1 - offset0) * interval.ColorSlope;
  this->Color +=
    this->Transmittance * (colorFront * gone + colorChange * std::max(0.0f, gone - front));
  this->Transmittance -= this->Transmittance * gone;
  return part;
}

}
