// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RayBlock.h"

#include "Simd/LaneLoop.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Relative error of a depth at which a side of the box is met: a difference, a reciprocal and a
 * product, each rounded by half an epsilon.
 */
constexpr double Rounding = 2.0 * std::numeric_limits<double>::epsilon();

/** Number of rays that are tested with a box at once: a register of the widest set. */
constexpr int GroupSize = 8;
static_assert(RayBlock::Size % GroupSize == 0, "groups fill the block");

struct LengthKernel
{
  void operator()(RayBlock& rays, int i) const
  {
    rays.Length[i] = glm::length(rays.GetDirection(i));
  }
};

struct InverseKernel
{
  void operator()(RayBlock& rays, int i) const
  {
    constexpr double smallest = 1e-300;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double component = rays.Direction[axis][i];
      rays.Inverse[axis][i] =
        1.0 / (std::fabs(component) < smallest ? std::copysign(smallest, component) : component);
    }
  }
};

/** Some of the rays of a block. */
struct RayGroup
{
  RayBlock& Rays;
  int First;
  int Count;
};

struct BoxKernel
{
  AxisBox Box;

  void operator()(RayGroup& group, int i) const
  {
    RayBlock& rays = group.Rays;
    const int ray = group.First + i;
    double near = rays.First[ray];
    double far = rays.Last[ray];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double start = rays.Start[axis][ray];
      const double inverse = rays.Inverse[axis][ray];
      const double a = (this->Box.Low[axis] - start) * inverse;
      const double b = (this->Box.High[axis] - start) * inverse;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    const double nearest = near - Rounding * std::fabs(near);
    const double farthest = far + Rounding * std::fabs(far);
    rays.Meets[ray] = nearest <= farthest ? 1 : 0;
  }
};

struct ReachKernel
{
  PatchReach Patch;

  void operator()(RayBlock& rays, int i) const
  {
    const PatchReach& patch = this->Patch;
    const FacetPlane::Meeting meeting = patch.Plane.Meet(rays.GetStart(i), rays.GetDirection(i));
    rays.Depth[i] = meeting.Depth;
    rays.X[i] = meeting.X;
    rays.Y[i] = meeting.Y;
    rays.Slant[i] = rays.Length[i] * std::fabs(patch.NormalLength / meeting.Along);
    const double facing = rays.Facing[i] * patch.Front * meeting.Along;
    const bool isAverted = facing < -patch.Spread * patch.NormalLength * rays.Length[i];
    const bool meets =
      patch.MayMeet(meeting, rays.GetDirection(i), rays.First[i], rays.Last[i]) & !isAverted;
    rays.Meets[i] = meets ? 1 : 0;
  }
};

/**
 * Finds the extremes of `count` > 0 numbers; of every eighth of them first, since these loops run
 * on several lanes at a time.
 */
template <typename Value>
void FindExtremes(int count, const Value& valueOf, double& lowest, double& highest)
{
  constexpr int width = 8;
  double low[width];
  double high[width];
  std::fill_n(low, width, valueOf(0));
  std::fill_n(high, width, valueOf(0));
  const auto add = [&](int i, int lane)
  {
    const double value = valueOf(i);
    low[lane] = std::min(low[lane], value);
    high[lane] = std::max(high[lane], value);
  };
  int i = 0;
  for (; i + width <= count; i += width)
  {
    for (int lane = 0; lane < width; ++lane)
    {
      add(i + lane, lane);
    }
  }
  for (; i < count; ++i)
  {
    add(i, 0);
  }
  lowest = *std::min_element(low, low + width);
  highest = *std::max_element(high, high + width);
}

}

//------------------------------------------------------------------------------
TubeBounds RayBlock::GetTube(double first) const
{
  TubeBounds tube;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* starts = this->Start[axis];
    const double* directions = this->Direction[axis];
    FindExtremes(
      this->Count, [=](int ray) { return starts[ray] + first * directions[ray]; },
      tube.StartLow[axis], tube.StartHigh[axis]);
    FindExtremes(
      this->Count, [=](int ray) { return directions[ray]; }, tube.DirectionLow[axis],
      tube.DirectionHigh[axis]);
  }
  return tube;
}

//------------------------------------------------------------------------------
TubeBounds RayBlock::GetUnitTube(double first) const
{
  TubeBounds tube = this->GetTube(first);
  const double* lengths = this->Length;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* directions = this->Direction[axis];
    FindExtremes(
      this->Count, [=](int ray) { return directions[ray] / lengths[ray]; }, tube.DirectionLow[axis],
      tube.DirectionHigh[axis]);
  }
  return tube;
}

//------------------------------------------------------------------------------
double RayBlock::GetFarthest() const
{
  return this->Count > 0 ? *std::max_element(this->Last, this->Last + this->Count) : 0.0;
}

//------------------------------------------------------------------------------
void CompleteRays(InstructionSet set, RayBlock& rays)
{
  RunLanes(LengthKernel(), set, rays);
}

//------------------------------------------------------------------------------
void InvertDirections(InstructionSet set, RayBlock& rays)
{
  RunLanes(InverseKernel(), set, rays);
}

//------------------------------------------------------------------------------
bool MeetsBox(const AxisBox& box, InstructionSet set, RayBlock& rays)
{
  const BoxKernel kernel{ box };
  for (int first = 0; first < rays.Count; first += GroupSize)
  {
    RayGroup group{ rays, first, std::min(GroupSize, rays.Count - first) };
    RunLanes(kernel, set, group);
    const std::int64_t* meets = rays.Meets + first;
    if (std::any_of(meets, meets + group.Count, [](std::int64_t ray) { return ray != 0; }))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void MeetPatchReach(const PatchReach& patch, InstructionSet set, RayBlock& rays)
{
  RunLanes(ReachKernel{ patch }, set, rays);
}

}
