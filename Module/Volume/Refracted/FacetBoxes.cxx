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

/** The limits by the upper and by the lower sides of boxes. */
struct TubeLimits
{
  SideLimits Highs[3];
  SideLimits Lows[3];

  explicit TubeLimits(const TubeClip& tube)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = tube.GetInverseLow()[axis];
      const double high = tube.GetInverseHigh()[axis];
      this->Highs[axis] = SideLimits(tube.GetLow()[axis], low, low > 0.0);
      this->Lows[axis] = SideLimits(tube.GetHigh()[axis], high, !(high > 0.0));
    }
  }
};

/** Loop body for one box. */
struct ClipKernel
{
  TubeLimits Tube;

  void operator()(BoxLanes& boxes, int i) const
  {
    double first = 0.0;
    double last = Infinity;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Tube.Highs[axis].Limit(boxes.High[axis][i], first, last);
      this->Tube.Lows[axis].Limit(boxes.Low[axis][i], first, last);
    }
    boxes.From[i] = first;
    boxes.To[i] = last;
  }
};

/** Loop body for one group of rays. */
struct GroupKernel
{
  AxisBox Box;

  void operator()(GroupTubes& groups, int i) const
  {
    double first = 0.0;
    double last = Infinity;
    for (int side = 0; side < GroupTubes::Sides; ++side)
    {
      SideLimits limits;
      limits.Place = groups.Place[side][i];
      limits.Inverse = groups.Inverse[side][i];
      limits.AddedToLast = groups.AddedToLast[side][i];
      limits.AddedToFirst = groups.AddedToFirst[side][i];
      limits.Limit(side < 3 ? this->Box.High[side] : this->Box.Low[side - 3], first, last);
    }
    groups.Meets[i] = first <= last ? 1 : 0;
  }
};

/** Bounds of the rays of a group from the depth `first` on. */
TubeBounds BoundGroup(double first, const RayBlock& rays, int group)
{
  TubeBounds tube;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < GroupTubes::GroupSize; ++i)
    {
      const int ray = group * GroupTubes::GroupSize + i;
      const double direction = rays.Direction[axis][ray];
      const double start = rays.Start[axis][ray] + first * direction;
      tube.StartLow[axis] = std::min(tube.StartLow[axis], start);
      tube.StartHigh[axis] = std::max(tube.StartHigh[axis], start);
      tube.DirectionLow[axis] = std::min(tube.DirectionLow[axis], direction);
      tube.DirectionHigh[axis] = std::max(tube.DirectionHigh[axis], direction);
    }
  }
  return tube;
}

}

//------------------------------------------------------------------------------
GroupTubes::GroupTubes(double first, const RayBlock& rays)
  : Count((rays.Count + GroupSize - 1) / GroupSize)
  , NumberOfRays(rays.Count)
{
  for (int group = 0; group < this->Count; ++group)
  {
    const TubeLimits tube{ TubeClip(BoundGroup(first, rays, group)) };
    for (int side = 0; side < Sides; ++side)
    {
      const SideLimits& limits = side < 3 ? tube.Highs[side] : tube.Lows[side - 3];
      this->Place[side][group] = limits.Place;
      this->Inverse[side][group] = limits.Inverse;
      this->AddedToLast[side][group] = limits.AddedToLast;
      this->AddedToFirst[side][group] = limits.AddedToFirst;
    }
  }
}

//------------------------------------------------------------------------------
RayRange GroupTubes::FindRays(const AxisBox& box, InstructionSet set)
{
  RunLanes(GroupKernel{ box }, set, *this);
  int first = 0;
  int end = this->Count;
  while (first < end && this->Meets[first] == 0)
  {
    ++first;
  }
  while (first < end && this->Meets[end - 1] == 0)
  {
    --end;
  }
  return { first * GroupSize, std::min(end * GroupSize, this->NumberOfRays) };
}

//------------------------------------------------------------------------------
void ClipBoxes(const TubeBounds& tube, InstructionSet set, FacetBoxes& boxes)
{
  const TubeClip clip(tube);
  const ClipKernel kernel{ TubeLimits(clip) };
  for (int k = 0; k < boxes.GetNumberOfLanes(); ++k)
  {
    BoxLanes& lanes = boxes.Lanes[static_cast<std::size_t>(k)];
    const TubeRange whole = clip.Clip(lanes.Whole, Infinity);
    lanes.MayMeet = whole.From <= whole.To;
    if (lanes.MayMeet)
    {
      RunLanes(kernel, set, lanes);
    }
  }
}

}
