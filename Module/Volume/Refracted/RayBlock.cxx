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

  void operator()(RayGroup& group, int i) const
  {
    RayBlock& rays = group.Rays;
    const int ray = group.First + i;
    const PatchReach& patch = this->Patch;
    const glm::dvec3 direction = rays.GetDirection(ray);
    const FacetPlane::Meeting meeting = patch.Plane.Meet(rays.GetStart(ray), direction);
    rays.Depth[ray] = meeting.Depth;
    rays.X[ray] = meeting.X;
    rays.Y[ray] = meeting.Y;
    rays.Slant[ray] = rays.Length[ray] * std::fabs(patch.NormalLength * meeting.Inverse);
    const double facing = rays.Facing[ray] * patch.Front * meeting.Along;
    const bool isAverted = facing < -patch.Spread * patch.NormalLength * rays.Length[ray];
    const bool meets =
      patch.MayMeet(meeting, direction, rays.First[ray], rays.Last[ray]) & !isAverted;
    rays.Meets[ray] = meets ? 1 : 0;
  }
};

/** The least or the largest of eight values, without a loop: loops within lanes are not unrolled.
 */
template <typename Value>
double FindLeast(const Value& at)
{
  return std::min(std::min(std::min(at(0), at(1)), std::min(at(2), at(3))),
    std::min(std::min(at(4), at(5)), std::min(at(6), at(7))));
}

template <typename Value>
double FindMost(const Value& at)
{
  return std::max(std::max(std::max(at(0), at(1)), std::max(at(2), at(3))),
    std::max(std::max(at(4), at(5)), std::max(at(6), at(7))));
}

/** Extremes of every eighth ray from a lane on. */
template <bool HasUnitDirections>
struct TubeKernel
{
  static_assert(RayBlock::Size == 8 * GroupSize, "a lane has eight rays");

  explicit TubeKernel(double first)
    : First(first)
  {
  }
  void operator()(RayGroup& group, int i) const
  {
    // Not a loop, which would be too long for the compiler to unroll.
    this->Bound(group.Rays, 0, i);
    this->Bound(group.Rays, 1, i);
    this->Bound(group.Rays, 2, i);
  }

private:
  void Bound(RayBlock& rays, int axis, int i) const
  {
    const auto start = [this, &rays, axis, i](int k)
    {
      const int ray = i + k * GroupSize;
      return rays.Start[axis][ray] + this->First * rays.Direction[axis][ray];
    };
    const auto direction = [&rays, axis, i](int k)
    {
      const int ray = i + k * GroupSize;
      const double value = rays.Direction[axis][ray];
      return HasUnitDirections ? value * (1.0 / rays.Length[ray]) : value;
    };
    rays.Low[axis][i] = FindLeast(start);
    rays.High[axis][i] = FindMost(start);
    rays.Low[3 + axis][i] = FindLeast(direction);
    rays.High[3 + axis][i] = FindMost(direction);
  }

  /** Depth at which the tube begins. */
  double First;
};

template <bool HasUnitDirections>
TubeBounds BoundRays(double first, InstructionSet set, RayBlock& rays)
{
  RayGroup group{ rays, 0, GroupSize };
  RunLanes(TubeKernel<HasUnitDirections>(first), set, group);
  TubeBounds tube;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto least = [&rays](int k)
    { return *std::min_element(rays.Low[k], rays.Low[k] + GroupSize); };
    const auto most = [&rays](int k)
    { return *std::max_element(rays.High[k], rays.High[k] + GroupSize); };
    tube.StartLow[axis] = least(axis);
    tube.StartHigh[axis] = most(axis);
    tube.DirectionLow[axis] = least(3 + axis);
    tube.DirectionHigh[axis] = most(3 + axis);
  }
  return tube;
}

}

//------------------------------------------------------------------------------
double RayBlock::GetFarthest() const
{
  if (this->Count < Size)
  {
    return this->Count > 0 ? *std::max_element(this->Last, this->Last + this->Count) : 0.0;
  }
  // Maxima of groups, which the compiler computes in lanes.
  double farthest[GroupSize];
  std::copy_n(this->Last, GroupSize, farthest);
  for (int first = GroupSize; first < Size; first += GroupSize)
  {
    for (int i = 0; i < GroupSize; ++i)
    {
      farthest[i] = std::max(farthest[i], this->Last[first + i]);
    }
  }
  return *std::max_element(farthest, farthest + GroupSize);
}

//------------------------------------------------------------------------------
void CompleteRays(InstructionSet set, RayBlock& rays)
{
  RunLanes(LengthKernel(), set, rays);
  for (int i = rays.Count; i < RayBlock::Size && rays.Count > 0; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Start[axis][i] = rays.Start[axis][0];
      rays.Direction[axis][i] = rays.Direction[axis][0];
    }
    rays.Length[i] = rays.Length[0];
  }
}

//------------------------------------------------------------------------------
TubeBounds FindTube(double first, InstructionSet set, RayBlock& rays)
{
  return BoundRays<false>(first, set, rays);
}

//------------------------------------------------------------------------------
TubeBounds FindUnitTube(double first, InstructionSet set, RayBlock& rays)
{
  return BoundRays<true>(first, set, rays);
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
void MeetPatchReach(
  const PatchReach& patch, const RayRange& range, InstructionSet set, RayBlock& rays)
{
  RayGroup group{ rays, range.First, range.End - range.First };
  RunLanes(ReachKernel{ patch }, set, group);
}

}
