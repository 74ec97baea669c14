// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/PatchIntersector.h"
#include "Simd/InstructionSets.h"

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
    this->Start = PatchStart(this->Patch, this->Plane, this->Size);
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
/** Rays of the block that may meet the patch, with their intersections with the plane. */
PatchIntersectionBatch PatchIntersector::SiftNear(RayBlock& rays) const
{
  MeetPatchReach(this->GetReach(), this->Set, rays);
  PatchIntersectionBatch lanes;
  if (std::all_of(rays.Meets, rays.Meets + rays.Count, [](std::int64_t ray) { return ray != 0; }))
  {
    lanes.Take(rays.Count, rays.Start, rays.Direction);
    std::copy_n(rays.Depth, rays.Count, lanes.Depth);
    std::copy_n(rays.X, rays.Count, lanes.X);
    std::copy_n(rays.Y, rays.Count, lanes.Y);
    std::copy_n(rays.Slant, rays.Count, lanes.Slant);
    return lanes;
  }
  // Without branches, since no prediction of them would hold.
  std::int32_t near[RayBlock::Size];
  int count = 0;
  for (int i = 0; i < rays.Count; ++i)
  {
    near[count] = i;
    count += rays.Meets[i] != 0 ? 1 : 0;
  }
  for (int lane = 0; lane < count; ++lane)
  {
    const int i = near[lane];
    lanes.Index[lane] = i;
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Start[axis][lane] = rays.Start[axis][i];
      lanes.Direction[axis][lane] = rays.Direction[axis][i];
    }
    lanes.Depth[lane] = rays.Depth[i];
    lanes.X[lane] = rays.X[i];
    lanes.Y[lane] = rays.Y[i];
    lanes.Slant[lane] = rays.Slant[i];
  }
  lanes.Count = count;
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
