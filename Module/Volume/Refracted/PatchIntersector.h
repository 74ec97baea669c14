// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Surface/PatchCrossings.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RayTubeTree.h"
#include "Refraction/Tubes/RefractedRayBounds.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/PatchIntersectionBatch.h"
#include "Volume/Refracted/RayBlock.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace meniscus
{

/** Intersection of a ray with a patch. */
struct MembraneHit
{
  double Depth;
  glm::dvec3 Normal;
};

/** Intersects rays with one patch. */
class PatchIntersector
{
public:
  /** @param rayLength length of the direction of a typical ray. */
  PatchIntersector(const CurvedPatch& patch, double rayLength, InstructionSet set);
  /** Prepares for other rays. */
  void SetRayLength(double rayLength) { this->Scale = this->Size / rayLength; }

  /** False if no ray of a tube meets the patch at a parameter in the range. */
  bool MayMeet(const TubeBounds& tube, const TubeRange& range) const;
  /**
   * Intersects some rays of a block with the patch; overwrites the block's results. Intersections
   * that are outside of First and Last, or do not agree with Facing, may be left out.
   * @param visit called with the number of each ray that meets the patch, and the hit.
   */
  template <typename Visit>
  void Meet(RayBlock& rays, const RayRange& range, const Visit& visit) const;
  /** The same for all rays of the block. */
  template <typename Visit>
  void Meet(RayBlock& rays, const Visit& visit) const
  {
    this->Meet(rays, { 0, rays.Count }, visit);
  }
  /** Rays that touch the patch, or run along it, within rounding; they pass it there. */
  std::int64_t GetNumberOfUndecidedRays() const { return this->UndecidedRays; }

  /**
   * Distance by which the normal at an intersection may be outside of the hull of the patch's
   * control points. Both causes are proportional to its derivatives: the intersection is outside of
   * the facet by up to Border, and the normal is linear along Newton's last step of up to LastStep,
   * to an accuracy of its square. The factor 50 is larger than the first and the second derivatives
   * of normals, which are sums of a few vectors of length 2.
   */
  static constexpr double NormalMargin = 50.0 * (1e-8 + 1e-5 * 1e-5);

private:
  const PatchReach& GetReach() const;
  const PatchStart& GetStart() const;
  PatchReach BoundReach() const;
  PatchIntersectionBatch SiftNear(RayBlock& rays, const RayRange& range) const;
  template <typename Visit>
  void MeetSteep(PatchIntersectionBatch& lanes, const Visit& visit) const;
  template <typename Visit>
  void MeetCurved(PatchIntersectionBatch& lanes, const Visit& visit) const;
  bool MayMeetTwice(double slant) const;
  /**
   * Finds all intersections of one ray with the patch: for rays that may meet it twice, and rays
   * for which Newton's method fails.
   */
  template <typename Visit>
  void MeetExactly(const PatchIntersectionBatch& lanes, int lane, const Visit& visit) const;

  /** A ray through an edge meets both of its patches, within the accuracy of Newton's method. */
  static constexpr double Border = 1e-8;
  /**
   * Length of Newton's last step, in units of the facet. The remaining error is its square times
   * the second derivatives of the patch and the slant of the ray, below 1e-9 for products of these
   * up to 10; the walk resolves 4e-9 of the mesh.
   */
  static constexpr double LastStep = 1e-5;
  static constexpr PatchSearchLimits SearchLimits{ LastStep, Border, PatchCrossings::Reach };
  /**
   * Limit of Newton's steps. From a place on the facet the method converges quadratically;
   * otherwise MeetExactly() takes over.
   */
  static constexpr int Steps = 12;

  CurvedPatch Patch;
  InstructionSet Set;
  FacetPlane Plane;
  double NormalLength;
  double Size;
  /** Depth along a ray of about the size of the facet. */
  double Scale;
  double Overhang;
  /**
   * Rays with at most this slant do not meet the patch twice: a cheap bound first, then the best
   * one.
   */
  mutable double LargestSlant;
  mutable bool IsSlantBest = false;
  /** Computed when they are needed first. */
  mutable PatchReach Reach;
  mutable bool HasReach = false;
  mutable PatchStart Start;
  mutable bool HasStart = false;
  mutable std::int64_t UndecidedRays = 0;
  bool IsFlat;
};

//------------------------------------------------------------------------------
template <typename Visit>
void PatchIntersector::Meet(RayBlock& rays, const RayRange& range, const Visit& visit) const
{
  PatchIntersectionBatch lanes = this->SiftNear(rays, range);
  if (!this->IsFlat)
  {
    this->MeetCurved(lanes, visit);
    return;
  }
  SetNormals(this->Patch, this->Set, lanes);
  for (int i = 0; i < lanes.Count; ++i)
  {
    visit(lanes.Index[i],
      MembraneHit{
        lanes.Depth[i], { lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i] } });
  }
}

//------------------------------------------------------------------------------
/** Intersects the rays that may meet the patch twice, and removes them. */
template <typename Visit>
void PatchIntersector::MeetSteep(PatchIntersectionBatch& lanes, const Visit& visit) const
{
  const int count = lanes.Count;
  bool isAnySteep = false;
  for (int i = 0; i < count; ++i)
  {
    isAnySteep |= !(lanes.Slant[i] <= this->LargestSlant);
  }
  lanes.Count = isAnySteep ? 0 : count;
  for (int i = 0; i < count && isAnySteep; ++i)
  {
    if (!(lanes.Slant[i] <= this->LargestSlant) && this->MayMeetTwice(lanes.Slant[i]))
    {
      this->MeetExactly(lanes, i, visit);
      continue;
    }
    lanes.Keep(lanes.Count++, i);
  }
}

//------------------------------------------------------------------------------
template <typename Visit>
void PatchIntersector::MeetCurved(PatchIntersectionBatch& lanes, const Visit& visit) const
{
  this->MeetSteep(lanes, visit);
  StartNearPatch(this->GetStart(), this->Set, lanes);
  for (int step = 0; step < Steps && lanes.Count > 0; ++step)
  {
    StepToPatch(this->Patch, this->Scale, this->Set, lanes);
    FindStates(SearchLimits, this->Scale, this->Set, lanes);
    const int count = lanes.Count;
    lanes.Count = 0;
    for (int i = 0; i < count; ++i)
    {
      const std::int64_t state = lanes.State[i];
      if (state == PatchSearch::Meets)
      {
        visit(lanes.Index[i],
          MembraneHit{ lanes.Depth[i] + lanes.Behind[i],
            { lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i] } });
      }
      else if (state == PatchSearch::GoesOn)
      {
        lanes.Keep(lanes.Count++, i);
      }
      // A root of the ray outside of the patch does not exclude another one inside.
      else if (state == PatchSearch::Fails || state == PatchSearch::EndsOutside)
      {
        this->MeetExactly(lanes, i, visit);
      }
    }
  }
  for (int i = 0; i < lanes.Count; ++i)
  {
    this->MeetExactly(lanes, i, visit);
  }
  lanes.Count = 0;
}

//------------------------------------------------------------------------------
/** A ray that touches the patch within rounding, undecided by PatchCrossings, counts as a miss. */
template <typename Visit>
void PatchIntersector::MeetExactly(
  const PatchIntersectionBatch& lanes, int lane, const Visit& visit) const
{
  const glm::dvec3 start = lanes.GetStart(lane);
  const glm::dvec3 direction = lanes.GetDirection(lane);
  const double length = glm::length(direction);
  const HeightFrame frame(direction / length);
  PatchCrossings crossings(this->Patch, frame);
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  crossings.Find(frame.Project(start), -anywhere, anywhere);
  this->UndecidedRays += crossings.IsComplete() ? 0 : 1;
  for (const PatchCrossing& crossing : crossings)
  {
    const double depth = (crossing.Height - frame.GetHeight(start)) / length;
    visit(lanes.Index[lane], MembraneHit{ depth, crossing.Normal });
  }
}

}
