// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/PatchIntersector.h"
#include "Simd/InstructionSets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** A patch whose distance from its facet is within the rounding of its corners is flat. */
constexpr double FlatBulge = 8.0 * std::numeric_limits<double>::epsilon();

}

//------------------------------------------------------------------------------
PatchIntersector::PatchIntersector(const CurvedPatch& patch, double rayLength, InstructionSet set)
  : Patch(patch)
  , Set(set)
{
  const glm::dvec3 u = patch.Corner[1] - patch.Corner[0];
  const glm::dvec3 v = patch.Corner[2] - patch.Corner[0];
  const glm::dvec3 normal = glm::cross(u, v);
  const double squared = glm::dot(normal, normal);
  this->NormalLength = std::sqrt(squared);
  this->Plane = { patch.Corner[0], normal, glm::cross(v, normal) / squared,
    glm::cross(normal, u) / squared };
  this->Size = std::sqrt(std::max({ glm::dot(u, u), glm::dot(v, v), glm::dot(u - v, u - v) }));
  this->SetRayLength(rayLength);
  // Barycentric coordinates change by 1 over an altitude of the facet.
  const double steepest = std::max({ glm::length(this->Plane.ByX), glm::length(this->Plane.ByY),
    glm::length(this->Plane.ByX + this->Plane.ByY) });
  const double bulge = BoundBulge(patch);
  this->IsFlat = bulge <= FlatBulge * this->Size;
  this->Overhang = this->IsFlat ? 0.0 : bulge * steepest;
  this->LargestSlant = this->IsFlat ? std::numeric_limits<double>::infinity()
                                    : PatchCrossings::BoundLargestSlant(patch);
}

//------------------------------------------------------------------------------
const PatchReach& PatchIntersector::GetReach() const
{
  if (!this->HasReach)
  {
    this->Reach = this->BoundReach();
    this->HasReach = true;
  }
  return this->Reach;
}

//------------------------------------------------------------------------------
const PatchStart& PatchIntersector::GetStart() const
{
  if (!this->HasStart)
  {
    this->Start = PatchStart(this->Patch, this->Plane, this->Size, this->GetReach().Spread);
    this->HasStart = true;
  }
  return this->Start;
}

//------------------------------------------------------------------------------
PatchReach PatchIntersector::BoundReach() const
{
  PatchReach reach;
  reach.Plane = this->Plane;
  reach.NormalLength = this->NormalLength;
  const glm::dvec3& winding = this->Plane.Normal;
  const glm::dvec3* normals = this->Patch.Normal;
  reach.Front = glm::dot(winding, normals[0] + normals[1] + normals[2]) < 0.0 ? -1.0 : 1.0;
  const glm::dvec3 middle = reach.Front / this->NormalLength * winding;
  double spread = 0.0; // squared
  for (const glm::dvec3& control : ComputeNormalControls(this->Patch))
  {
    const glm::dvec3 difference = control - middle;
    spread = std::max(spread, glm::dot(difference, difference));
  }
  reach.Spread = std::sqrt(spread) + NormalMargin;
  // The component of a unit normal along the plane is at most its difference from the plane's.
  reach.Overhang = std::min(reach.Spread, 1.0) * this->Overhang + Border;
  if (this->IsFlat)
  {
    reach.Low = reach.High = 0.0;
    return reach;
  }
  const BulgeBounds bulges = BoundBulges(this->Patch);
  const double margin = PatchCrossings::Margin * this->Size;
  reach.Low = (reach.Front > 0.0 ? bulges.Below : -bulges.Above) - margin;
  reach.High = (reach.Front > 0.0 ? bulges.Above : -bulges.Below) + margin;
  return reach;
}

//------------------------------------------------------------------------------
/**
 * The heights of the rays above the plane of the facet are linear in the parameter. The margin is
 * that of the boxes around patches, which covers the rounding of positions.
 */
bool PatchIntersector::MayMeet(const TubeBounds& tube, const TubeRange& range) const
{
  const glm::dvec3& normal = this->Plane.Normal;
  const glm::dvec3 toLow = normal * (tube.StartLow - this->Plane.Corner);
  const glm::dvec3 toHigh = normal * (tube.StartHigh - this->Plane.Corner);
  const glm::dvec3 byLow = normal * tube.DirectionLow;
  const glm::dvec3 byHigh = normal * tube.DirectionHigh;
  const auto sum = [](const glm::dvec3& v) { return v.x + v.y + v.z; };
  const double least = sum(glm::min(toLow, toHigh));
  const double most = sum(glm::max(toLow, toHigh));
  const double leastBy = sum(glm::min(byLow, byHigh));
  const double mostBy = sum(glm::max(byLow, byHigh));
  const double lowest = least + std::min(range.From * leastBy, range.To * leastBy);
  const double highest = most + std::max(range.From * mostBy, range.To * mostBy);
  const PatchReach& reach = this->GetReach();
  const double margin = PatchCrossings::Margin * this->Size;
  // The comparisons are false for a NaN, which an infinite range may lead to.
  return !(lowest > (reach.High + margin) * this->NormalLength ||
    highest < (reach.Low - margin) * this->NormalLength);
}

//------------------------------------------------------------------------------
/**
 * Rays of a range that may meet the patch, with their intersections with the plane. For a flat
 * patch these are the results, and the rays themselves are left out.
 */
PatchIntersectionBatch PatchIntersector::SiftNear(RayBlock& rays, const RayRange& range) const
{
  MeetPatchReach(this->GetReach(), range, this->Set, rays);
  PatchIntersectionBatch lanes;
  // Without branches, since no prediction of them would hold.
  std::int32_t near[RayBlock::Size];
  int count = 0;
  for (int i = range.First; i < range.End; ++i)
  {
    near[count] = i;
    count += rays.Meets[i] != 0 ? 1 : 0;
  }
  lanes.Count = count;
  std::copy_n(near, count, lanes.Index);
  if (count == rays.Count)
  {
    std::copy_n(rays.Depth, count, lanes.Depth);
    std::copy_n(rays.X, count, lanes.X);
    std::copy_n(rays.Y, count, lanes.Y);
  }
  for (int lane = 0; lane < count && count < rays.Count; ++lane)
  {
    const int i = near[lane];
    lanes.Depth[lane] = rays.Depth[i];
    lanes.X[lane] = rays.X[i];
    lanes.Y[lane] = rays.Y[i];
  }
  for (int lane = 0; lane < count && !this->IsFlat; ++lane)
  {
    const int i = near[lane];
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Start[axis][lane] = rays.Start[axis][i];
      lanes.Direction[axis][lane] = rays.Direction[axis][i];
    }
    lanes.Slant[lane] = rays.Slant[i];
  }
  return lanes;
}

//------------------------------------------------------------------------------
bool PatchIntersector::MayMeetTwice(double slant) const
{
  if (!this->IsSlantBest)
  {
    this->LargestSlant = PatchCrossings(this->Patch, HeightFrame()).GetLargestSlant();
    this->IsSlantBest = true;
  }
  return !(slant <= this->LargestSlant);
}

}
