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

/** Number of rays that are tested with a box at once: two registers of the widest set. */
constexpr int GroupSize = 16;
static_assert(RayBlock::Size % GroupSize == 0, "groups fill the block");

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
    const double perHeight = patch.NormalLength / meeting.Along;
    rays.Depth[i] = meeting.Depth;
    rays.X[i] = meeting.X;
    rays.Y[i] = meeting.Y;
    rays.Slant[i] = rays.Length[i] * std::fabs(perHeight);
    // Depths behind the plane between which the ray is at the heights of the patch.
    const double low = patch.Low * perHeight;
    const double high = patch.High * perHeight;
    const double begin = std::max(std::min(low, high), rays.First[i] - meeting.Depth);
    const double end = std::min(std::max(low, high), rays.Last[i] - meeting.Depth);
    const double byX = glm::dot(patch.Plane.ByX, rays.GetDirection(i));
    const double byY = glm::dot(patch.Plane.ByY, rays.GetDirection(i));
    const double x = meeting.X + std::max(begin * byX, end * byX);
    const double y = meeting.Y + std::max(begin * byY, end * byY);
    const double rest =
      1.0 - meeting.X - meeting.Y - std::min(begin * (byX + byY), end * (byX + byY));
    const double facing = rays.Facing[i] * patch.Front * meeting.Along;
    // The comparisons are written so that a NaN counts as a meeting: the ray is within the plane.
    const bool passes = (x < -patch.Overhang) | (y < -patch.Overhang) | (rest < -patch.Overhang);
    const bool isAverted = facing < -patch.Spread * patch.NormalLength * rays.Length[i];
    rays.Meets[i] = (passes | isAverted | (begin > end)) ? 0 : 1;
  }
};

}

//------------------------------------------------------------------------------
void RayBlock::Add(
  const glm::dvec3& start, const glm::dvec3& direction, double first, double facing)
{
  constexpr double smallest = 1e-300;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double component = direction[axis];
    this->Start[axis][this->Count] = start[axis];
    this->Direction[axis][this->Count] = component;
    this->Inverse[axis][this->Count] =
      1.0 / (std::fabs(component) < smallest ? std::copysign(smallest, component) : component);
  }
  this->Length[this->Count] = glm::length(direction);
  this->First[this->Count] = first;
  this->Last[this->Count] = std::numeric_limits<double>::infinity();
  this->Facing[this->Count] = facing;
  ++this->Count;
}

//------------------------------------------------------------------------------
TubeBounds RayBlock::GetTube(double first) const
{
  TubeBounds tube;
  for (int i = 0; i < this->Count; ++i)
  {
    tube.Add(this->GetStart(i) + first * this->GetDirection(i), this->GetDirection(i));
  }
  return tube;
}

//------------------------------------------------------------------------------
double RayBlock::GetFarthest() const
{
  return this->Count > 0 ? *std::max_element(this->Last, this->Last + this->Count) : 0.0;
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
