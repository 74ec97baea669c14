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
bool VisibilityBounds::Meets(const TubeBounds& tube, double last) const
{
  double first = 0.0;
  const auto constrain = [&first, &last](double offset, double rate)
  {
    // offset + t rate >= 0
    first = rate > 0.0 ? std::max(first, -offset / rate) : first;
    last = rate < 0.0 ? std::min(last, -offset / rate) : last;
    last = rate == 0.0 && offset < 0.0 ? -1.0 : last;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    constrain(
      tube.StartHigh[axis] + this->Half[axis] - this->Center[axis], tube.DirectionHigh[axis]);
    constrain(
      this->Center[axis] - tube.StartLow[axis] + this->Half[axis], -tube.DirectionLow[axis]);
  }
  return first <= last;
}

//------------------------------------------------------------------------------
bool VisibilityBounds::MayBeSeen(const DirectionBox& sight, DirectionBox normal,
  const glm::dvec3* points, int count, double reach) const
{
  const CosineBounds cosine = BoundCosine(sight, normal);
  const bool fromBehind = cosine.Least > 0.0;
  if (!fromBehind && !(cosine.Most < 0.0))
  {
    return true;
  }
  normal.Middle = fromBehind ? -normal.Middle : normal.Middle;
  const TubeBounds toEye =
    BoundRays(-sight.Middle - sight.Half, -sight.Middle + sight.Half, points, count, reach);
  const TubeBounds refracted = BoundRefractedRays(
    sight, normal, fromBehind ? 1.0 / this->Ratio : this->Ratio, points, count, reach);
  // Without valid bounds all rays are totally reflected.
  return this->Meets(toEye) || (refracted.IsValid() && this->Meets(refracted));
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
  this->Bulge = BoundBulge(patch);
  this->IsFlat = this->Bulge <= FlatBulge * this->Size;
  this->Overhang = this->IsFlat ? 0.0 : this->Bulge * steepest;
  this->LargestSlant = this->IsFlat ? std::numeric_limits<double>::infinity()
                                    : PatchCrossings::BoundLargestSlant(patch);
}

//------------------------------------------------------------------------------
PatchIntersector::FlatHits PatchIntersector::MeetPlane(const CornerRays& rays) const
{
  FlatHits hits;
  double least = std::numeric_limits<double>::infinity();
  double longest = 0.0;
  int front = 0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const glm::dvec3& direction = rays.Directions[corner];
    const glm::dvec3 toCorner = this->Plane.Corner - rays.Starts[corner];
    const double along = glm::dot(this->Plane.Normal, direction);
    const glm::dvec3 inPlane =
      glm::dot(this->Plane.Normal, toCorner) / along * direction - toCorner;
    hits.Places[corner] = this->Plane.Corner + inPlane;
    hits.Coordinates[corner] = { glm::dot(inPlane, this->Plane.ByX),
      glm::dot(inPlane, this->Plane.ByY) };
    hits.Along[corner] = std::fabs(along);
    front += along > 0.0 ? 1 : 0;
    least = std::min(least, hits.Along[corner]);
    longest = std::max(longest, glm::dot(direction, direction));
  }
  hits.FromOneSide = front == 0 || front == 4;
  // Directions are affine in the pixel.
  hits.Slant = std::sqrt(longest) * this->NormalLength / least;
  // The margin is widened once more by the width of an edge.
  hits.Margin = this->MarginOf(hits.Slant) + Border;
  return hits;
}

//------------------------------------------------------------------------------
bool PatchIntersector::IsBeside(const FlatHits& hits) const
{
  int outside[3] = { 0, 0, 0 };
  for (const glm::dvec2& b : hits.Coordinates)
  {
    outside[0] += 1.0 - b.x - b.y < -hits.Margin ? 1 : 0;
    outside[1] += b.x < -hits.Margin ? 1 : 0;
    outside[2] += b.y < -hits.Margin ? 1 : 0;
  }
  return hits.FromOneSide && (outside[0] == 4 || outside[1] == 4 || outside[2] == 4);
}

//------------------------------------------------------------------------------
/**
 * Bounds of the unit normals over a quadrilateral in barycentric coordinates, widened by `margin`.
 * Its two halves are Bezier triangles of second degree; their control points are values of the
 * polar form.
 */
DirectionBox PatchIntersector::BoundNormalsOver(const glm::dvec2 (&b)[4], double margin) const
{
  const CurvedPatch& patch = this->Patch;
  const auto polar = [&patch](const glm::dvec2& p, const glm::dvec2& q)
  {
    const glm::dvec3 f(1.0 - p.x - p.y, p.x, p.y);
    const glm::dvec3 g(1.0 - q.x - q.y, q.x, q.y);
    const glm::dvec3 m = 0.5 * (f + g);
    return m.x * patch.Normal[0] + m.y * patch.Normal[1] + m.z * patch.Normal[2] +
      0.5 * (f.y * g.z + f.z * g.y) * patch.Bend[0] +
      0.5 * (f.z * g.x + f.x * g.z) * patch.Bend[1] + 0.5 * (f.x * g.y + f.y * g.x) * patch.Bend[2];
  };
  const glm::dvec3 control[9] = { polar(b[0], b[0]), polar(b[1], b[1]), polar(b[2], b[2]),
    polar(b[3], b[3]), polar(b[0], b[1]), polar(b[1], b[2]), polar(b[2], b[3]), polar(b[3], b[0]),
    polar(b[0], b[2]) };
  double slope =
    glm::length(patch.Normal[1] - patch.Normal[0]) + glm::length(patch.Normal[2] - patch.Normal[0]);
  double farthest = 1.0 + margin;
  for (const glm::dvec2& place : b)
  {
    farthest = std::max(farthest, 1.0 + margin + std::fabs(place.x) + std::fabs(place.y));
  }
  for (const glm::dvec3& bend : patch.Bend)
  {
    // Derivative of b_i b_j by both coordinates, which are at most `farthest`.
    slope += 4.0 * farthest * glm::length(bend);
  }
  return BoundDirections(
    0.25 * (control[0] + control[1] + control[2] + control[3]), control, 9, slope * margin);
}

//------------------------------------------------------------------------------
/** Keeps only rays that may meet the patch, including those within the facet's plane (0 / 0). */
void PatchIntersector::SiftNear(PatchIntersectionBatch& lanes) const
{
  const int count = lanes.Count;
  lanes.Count = 0;
  for (int i = 0; i < count; ++i)
  {
    if (!(lanes.Least[i] < -this->MarginOf(lanes.Slant[i])))
    {
      lanes.Keep(lanes.Count++, i);
    }
  }
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
bool PatchIntersector::Passes(
  const SightRays& rays, const PatchIntersectionBatch& lanes, int lane) const
{
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const glm::dvec3 direction = rays.DirectionOf(lanes, lane);
  return !this->GetReach().MayMeet(
    this->Plane.Meet(rays.StartOf(lanes, lane), direction), direction, -anywhere, anywhere);
}

//------------------------------------------------------------------------------
/** Rays of the block that may meet the patch, with their intersections with the plane. */
FreeRayBatch PatchIntersector::SiftNear(RayBlock& rays) const
{
  MeetPatchReach(this->GetReach(), this->Set, rays);
  FreeRayBatch lanes;
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
bool PatchIntersector::Matters(
  const FlatHits& hits, const CornerRays& rays, const VisibilityBounds& mesh) const
{
  if (!hits.FromOneSide)
  {
    return true;
  }
  const glm::dvec3 middle =
    0.25 * (rays.Directions[0] + rays.Directions[1] + rays.Directions[2] + rays.Directions[3]);
  return mesh.MayBeSeen(BoundDirections(middle, rays.Directions, 4, 0.0),
    this->BoundNormalsOver(hits.Coordinates, hits.Margin), hits.Places, 4,
    this->Bulge * hits.Slant);
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

//------------------------------------------------------------------------------
PatchCoverage::PatchCoverage(const PatchIntersector::FlatHits& hits, int columns, int rows)
  : Columns(columns)
  , All(!hits.FromOneSide)
{
  double at[3][4];
  for (int corner = 0; corner < 4; ++corner)
  {
    // With the common denominator multiplied out.
    const glm::dvec2& b = hits.Coordinates[corner];
    at[0][corner] = (1.0 - b.x - b.y + hits.Margin) * hits.Along[corner];
    at[1][corner] = (b.x + hits.Margin) * hits.Along[corner];
    at[2][corner] = (b.y + hits.Margin) * hits.Along[corner];
  }
  for (int k = 0; k < 3; ++k)
  {
    this->Edge[k][0] = at[k][0];
    this->Edge[k][1] = (at[k][1] - at[k][0]) / std::max(columns - 1, 1);
    this->Edge[k][2] = (at[k][3] - at[k][0]) / std::max(rows - 1, 1);
  }
}

//------------------------------------------------------------------------------
PatchCoverage::Span PatchCoverage::OfRow(int row) const
{
  if (this->All)
  {
    return { 0, this->Columns };
  }
  double first = 0.0;
  double last = this->Columns - 1.0;
  for (const auto& edge : this->Edge)
  {
    // Column in which the edge is crossed, with one more pixel for its rounding.
    const double start = edge[0] + row * edge[2];
    const double crossing = -start / edge[1];
    first = edge[1] > 0.0 ? std::max(first, crossing - 1.0) : first;
    last = edge[1] < 0.0 ? std::min(last, crossing + 1.0) : last;
    last = edge[1] == 0.0 && start < 0.0 ? -1.0 : last;
  }
  return first <= last ? Span{ static_cast<int>(first), static_cast<int>(last) + 1 } : Span{ 0, 0 };
}

}
