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
 * Extremes of the numbers of rays, one for each lane of a group: beginnings, directions and unit
 * directions.
 */
struct TubeGroup
{
  static constexpr int Numbers = 9;

  explicit TubeGroup(const RayBlock& rays)
    : Rays(rays)
  {
    std::fill_n(this->Low[0], Numbers * GroupSize, std::numeric_limits<double>::max());
    std::fill_n(this->High[0], Numbers * GroupSize, std::numeric_limits<double>::lowest());
  }

  const RayBlock& Rays;
  int First = 0;
  int Count = GroupSize;
  double Low[Numbers][GroupSize];
  double High[Numbers][GroupSize];
};

struct TubeKernel
{
  /** Depth at which the tube begins. */
  double First;

  void operator()(TubeGroup& group, int i) const
  {
    const RayBlock& rays = group.Rays;
    const int ray = group.First + i;
    const double perLength = 1.0 / rays.Length[ray];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double direction = rays.Direction[axis][ray];
      const double start = rays.Start[axis][ray] + this->First * direction;
      const double unit = direction * perLength;
      group.Low[axis][i] = std::min(group.Low[axis][i], start);
      group.High[axis][i] = std::max(group.High[axis][i], start);
      group.Low[3 + axis][i] = std::min(group.Low[3 + axis][i], direction);
      group.High[3 + axis][i] = std::max(group.High[3 + axis][i], direction);
      group.Low[6 + axis][i] = std::min(group.Low[6 + axis][i], unit);
      group.High[6 + axis][i] = std::max(group.High[6 + axis][i], unit);
    }
  }
};

}

//------------------------------------------------------------------------------
double RayBlock::GetFarthest() const
{
  return this->Count > 0 ? *std::max_element(this->Last, this->Last + this->Count) : 0.0;
}

//------------------------------------------------------------------------------
void CompleteRays(InstructionSet set, RayBlock& rays)
{
  for (int i = rays.Count; i % GroupSize != 0; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Start[axis][i] = rays.Start[axis][0];
      rays.Direction[axis][i] = rays.Direction[axis][0];
    }
  }
  RunLanes(LengthKernel(), set, rays);
}

//------------------------------------------------------------------------------
RayTubes FindTubes(double first, InstructionSet set, const RayBlock& rays)
{
  TubeGroup group(rays);
  for (; group.First < rays.Count; group.First += GroupSize)
  {
    RunLanes(TubeKernel{ first }, set, group);
  }
  double low[TubeGroup::Numbers];
  double high[TubeGroup::Numbers];
  for (int k = 0; k < TubeGroup::Numbers; ++k)
  {
    low[k] = *std::min_element(group.Low[k], group.Low[k] + GroupSize);
    high[k] = *std::max_element(group.High[k], group.High[k] + GroupSize);
  }
  RayTubes tubes;
  tubes.ByDepth = { { low[0], low[1], low[2] }, { high[0], high[1], high[2] },
    { low[3], low[4], low[5] }, { high[3], high[4], high[5] } };
  tubes.ByLength = tubes.ByDepth;
  tubes.ByLength.DirectionLow = { low[6], low[7], low[8] };
  tubes.ByLength.DirectionHigh = { high[6], high[7], high[8] };
  return tubes;
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
