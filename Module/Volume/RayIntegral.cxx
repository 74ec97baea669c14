// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/RayIntegral.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** Nodes and weights of Gauss-Legendre quadrature on [0, 1]. */
constexpr float Nodes[4] = { 0.06943184420297f, 0.33000947820757f, 0.66999052179243f,
  0.93056815579703f };
constexpr float Weights[4] = { 0.17392742256873f, 0.32607257743127f, 0.32607257743127f,
  0.17392742256873f };
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
  float front = 0.0f;
  for (int i = 0; i < 4; ++i)
  {
    const float x = part * Nodes[i];
    front +=
      Weights[i] * Absorbed(std::min(std::max(x * (density + 0.5f * x * slope), 0.0f), 1.0f));
  }
  const glm::vec3 colorFront = interval.Color + offset0 * interval.ColorSlope;
  const glm::vec3 colorChange = part * (offset1 - offset0) * interval.ColorSlope;
  this->Color +=
    this->Transmittance * (colorFront * gone + colorChange * std::max(0.0f, gone - front));
  this->Transmittance -= this->Transmittance * gone;
  return part;
}

}
