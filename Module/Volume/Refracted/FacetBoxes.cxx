// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/FacetBoxes.h"

#include "Simd/LaneLoop.h"

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** The planes of one side of boxes across an axis, each of which limits one end of a range. */
struct SideLimits
{
  double Place = 0.0;
  double Inverse = 0.0;
  /** Added to limits of each end: 0, or what makes them no limits. */
  double AddedToLast = 0.0;
  double AddedToFirst = 0.0;

  SideLimits() = default;
  SideLimits(double place, double inverse, bool limitsLast)
    : Place(place)
    , Inverse(inverse)
    , AddedToLast(limitsLast ? 0.0 : Infinity)
    , AddedToFirst(limitsLast ? -Infinity : 0.0)
  {
  }
  /** A sum of two infinities is not a number, which is no limit either. */
  void Limit(double plane, double& first, double& last) const
  {
    const double at = (plane - this->Place) * this->Inverse;
    last = std::min(last, at + this->AddedToLast);
    first = std::max(first, at + this->AddedToFirst);
  }
};

/** Loop body for one box. */
struct ClipKernel
{
  SideLimits Highs[3];
  SideLimits Lows[3];

  explicit ClipKernel(const TubeClip& tube)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = tube.GetInverseLow()[axis];
      const double high = tube.GetInverseHigh()[axis];
      this->Highs[axis] = SideLimits(tube.GetLow()[axis], low, low > 0.0);
      this->Lows[axis] = SideLimits(tube.GetHigh()[axis], high, !(high > 0.0));
    }
  }
  void operator()(FacetBoxes& boxes, int i) const
  {
    double first = 0.0;
    double last = Infinity;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Highs[axis].Limit(boxes.High[axis][i], first, last);
      this->Lows[axis].Limit(boxes.Low[axis][i], first, last);
    }
    boxes.From[i] = first;
    boxes.To[i] = last;
  }
};

}

//------------------------------------------------------------------------------
void ClipBoxes(const TubeBounds& tube, InstructionSet set, FacetBoxes& boxes)
{
  RunLanes(ClipKernel(TubeClip(tube)), set, boxes);
}

}
