// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_PatchIntersector_h
#define meniscus_Volume_Refracted_PatchIntersector_h

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Surface/PatchCrossings.h"
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

/**
 * Factor larger than the relative change of a distance by rounding, in any view that shows a part
 * of the ball.
 */
constexpr double SightMargin = 1.0 + 1e-6;

/**
 * Rays at the corners of a rectangle of pixels, in order around it; directions per unit of depth.
 */
struct CornerRays
{
  glm::dvec3 Starts[4];
  glm::dvec3 Directions[4];
};

/** Bounds of the visible geometry, in front of the membrane and behind it. */
struct VisibilityBounds
{
  /** Centre and half extents of a box along the world's axes. */
  glm::dvec3 Center{ 0.0 };
  glm::dvec3 Half{ 0.0 };
  /** n1 / n2, for rays against the normals. */
  double Ratio = 1.0;

  /** True if the box meets the tube up to the parameter `last`. */
  bool Meets(const TubeBounds& tube, double last = std::numeric_limits<double>::infinity()) const;
  /**
   * True if rays may reach the box that meet the membrane within `reach` of the hull of `count`
   * points: between the eye and the membrane, or after refraction.
   */
  bool MayBeSeen(const DirectionBox& sight, DirectionBox normal, const glm::dvec3* points,
    int count, double reach) const;
};

/** Nearest intersection of a pixel's ray with the membrane. */
struct MembraneHit
{
  double Depth = std::numeric_limits<double>::infinity();
  /** 0 if the ray cannot reach the mesh, so that its refraction is not needed. */
  glm::dvec3 Normal{ 0.0 };
};

/** Intersects rays with one patch. */
class PatchIntersector
{
public:
  /** @param rayLength length of the direction of a typical ray. */
  PatchIntersector(const CurvedPatch& patch, double rayLength, InstructionSet set);
  /** Prepares for other rays. */
  void SetRayLength(double rayLength) { this->Scale = this->Size / rayLength; }

  /** Intersections of the rays of a rectangle of pixels with the plane of the facet. */
  struct FlatHits
  {
    /**
     * Intersections of the rays at the corners: places, and barycentric coordinates in the facet.
     */
    glm::dvec3 Places[4];
    glm::dvec2 Coordinates[4];
    /**
     * Components of these rays' directions along the facet's normal; positive if all rays pass the
     * plane from one side.
     */
    double Along[4];
    bool FromOneSide;
    /**
     * Upper bound, over the rays of the rectangle, of the length of a direction over its component
     * along the normal.
     */
    double Slant;
    /**
     * Rays that meet the patch meet the plane within this distance of the facet, in barycentric
     * coordinates.
     */
    double Margin;
  };
  FlatHits MeetPlane(const CornerRays& rays) const;

  /** True if none of the rays meets the patch. */
  bool IsBeside(const FlatHits& hits) const;
  /** True if rays that meet the patch may reach the mesh. */
  bool Matters(const FlatHits& hits, const CornerRays& rays, const VisibilityBounds& mesh) const;

  /**
   * Intersects rays with the patch; overwrites the lanes.
   * @param matters false: these rays show no part of the mesh, so hits get no normal, and the depth
   *   of the facet's plane unless they are near its edges.
   * @param visit called with the index of each ray that meets the patch, and the hit.
   */
  template <typename Visit>
  void Meet(
    const SightRays& rays, bool matters, PatchIntersectionBatch& lanes, const Visit& visit) const;
  /**
   * Intersects the rays of a block with the patch; overwrites the block's results. Intersections
   * that are outside of First and Last, or do not agree with Facing, may be left out.
   * @param visit called with the number of each ray that meets the patch, and the hit.
   */
  template <typename Visit>
  void Meet(RayBlock& rays, const Visit& visit) const;
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
  DirectionBox BoundNormalsOver(const glm::dvec2 (&b)[4], double margin) const;
  void SiftNear(PatchIntersectionBatch& lanes) const;
  const PatchReach& GetReach() const;
  const PatchStart& GetStart() const;
  PatchReach BoundReach() const;
  FreeRayBatch SiftNear(RayBlock& rays) const;
  template <class Rays, typename Visit>
  void MeetNear(
    const Rays& rays, bool matters, typename Rays::Batch& lanes, const Visit& visit) const;
  /**
   * Bound of the distance, in barycentric coordinates, between a ray's intersection with the plane
   * and its intersection with the patch. A point of the patch lies within the bulge of a point of
   * the facet; the ray through it meets the plane within bulge (1 + slant) of that.
   */
  double MarginOf(double slant) const { return this->Overhang * (1.0 + slant) + Border; }
  /** True if a ray is certain to pass the patch. Rays of a block were tested before. */
  bool Passes(const SightRays& rays, const PatchIntersectionBatch& lanes, int lane) const;
  bool Passes(const FreeRays&, const FreeRayBatch&, int) const { return false; }
  template <class Rays, typename Visit>
  void MeetSteep(
    const Rays& rays, bool matters, typename Rays::Batch& lanes, const Visit& visit) const;
  template <class Rays, typename Visit>
  void MeetCurved(
    const Rays& rays, bool matters, typename Rays::Batch& lanes, const Visit& visit) const;
  bool MayMeetTwice(double slant) const;
  /**
   * Finds all intersections of one ray with the patch: for rays that may meet it twice, and those
   * for which Newton's method fails.
   */
  template <class Rays, typename Visit>
  void MeetExactly(const Rays& rays, bool matters, const typename Rays::Batch& lanes, int lane,
    const Visit& visit) const;

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
  double Bulge;
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
void PatchIntersector::Meet(
  const SightRays& rays, bool matters, PatchIntersectionBatch& lanes, const Visit& visit) const
{
  meniscus::MeetPlane(this->Plane, rays, this->Set, lanes);
  this->SiftNear(lanes);
  this->MeetNear(rays, matters, lanes, visit);
}

//------------------------------------------------------------------------------
template <typename Visit>
void PatchIntersector::Meet(RayBlock& rays, const Visit& visit) const
{
  FreeRayBatch lanes = this->SiftNear(rays);
  this->MeetNear(FreeRays(), true, lanes, visit);
}

//------------------------------------------------------------------------------
/** Intersects rays, of which the intersections with the plane are known, with the patch. */
template <class Rays, typename Visit>
void PatchIntersector::MeetNear(
  const Rays& rays, bool matters, typename Rays::Batch& lanes, const Visit& visit) const
{
  if (matters && this->IsFlat)
  {
    SetNormals(this->Patch, this->Set, lanes);
    for (int i = 0; i < lanes.Count; ++i)
    {
      visit(lanes.Index[i],
        MembraneHit{
          lanes.Depth[i], { lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i] } });
    }
    lanes.Count = 0;
    return;
  }
  const int count = lanes.Count;
  lanes.Count = matters ? count : 0;
  for (int i = 0; i < count && !matters; ++i)
  {
    if (!this->IsFlat && !(lanes.Least[i] > this->MarginOf(lanes.Slant[i])))
    {
      lanes.Keep(lanes.Count++, i);
      continue;
    }
    visit(lanes.Index[i], MembraneHit{ lanes.Depth[i], glm::dvec3(0.0) });
  }
  this->MeetCurved(rays, matters, lanes, visit);
}

//------------------------------------------------------------------------------
/** Intersects the rays that may meet the patch twice, and removes them. */
template <class Rays, typename Visit>
void PatchIntersector::MeetSteep(
  const Rays& rays, bool matters, typename Rays::Batch& lanes, const Visit& visit) const
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
      this->MeetExactly(rays, matters, lanes, i, visit);
      continue;
    }
    lanes.Keep(lanes.Count++, i);
  }
}

//------------------------------------------------------------------------------
template <class Rays, typename Visit>
void PatchIntersector::MeetCurved(
  const Rays& rays, bool matters, typename Rays::Batch& lanes, const Visit& visit) const
{
  this->MeetSteep(rays, matters, lanes, visit);
  StartNearPatch(this->GetStart(), rays, this->Set, lanes);
  for (int step = 0; step < Steps && lanes.Count > 0; ++step)
  {
    StepToPatch(this->Patch, rays, this->Scale, this->Set, lanes);
    FindStates(SearchLimits, this->Scale, this->Set, lanes);
    const int count = lanes.Count;
    lanes.Count = 0;
    for (int i = 0; i < count; ++i)
    {
      const std::int64_t state = lanes.State[i];
      if (state == PatchSearch::Meets)
      {
        const glm::dvec3 normal(lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i]);
        visit(lanes.Index[i],
          MembraneHit{ lanes.Depth[i] + lanes.Behind[i], matters ? normal : glm::dvec3(0.0) });
      }
      else if (state == PatchSearch::GoesOn)
      {
        lanes.Keep(lanes.Count++, i);
      }
      // A root of the ray outside of the patch does not exclude another one inside.
      else if (state == PatchSearch::Fails ||
        (state == PatchSearch::EndsOutside && !this->Passes(rays, lanes, i)))
      {
        this->MeetExactly(rays, matters, lanes, i, visit);
      }
    }
  }
  for (int i = 0; i < lanes.Count; ++i)
  {
    this->MeetExactly(rays, matters, lanes, i, visit);
  }
  lanes.Count = 0;
}

//------------------------------------------------------------------------------
/** A ray that touches the patch within rounding, undecided by PatchCrossings, counts as a miss. */
template <class Rays, typename Visit>
void PatchIntersector::MeetExactly(const Rays& rays, bool matters,
  const typename Rays::Batch& lanes, int lane, const Visit& visit) const
{
  const glm::dvec3 start = rays.StartOf(lanes, lane);
  const glm::dvec3 direction = rays.DirectionOf(lanes, lane);
  const double length = glm::length(direction);
  const HeightFrame frame(direction / length);
  PatchCrossings crossings(this->Patch, frame);
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  crossings.Find(frame.Project(start), -anywhere, anywhere);
  this->UndecidedRays += crossings.IsComplete() ? 0 : 1;
  for (const PatchCrossing& crossing : crossings)
  {
    const double depth = (crossing.Height - frame.GetHeight(start)) / length;
    visit(lanes.Index[lane], MembraneHit{ depth, matters ? crossing.Normal : glm::dvec3(0.0) });
  }
}

/**
 * Pixels of a rectangle whose rays may meet a patch. The side of an edge on which a ray passes is
 * the sign of an affine function of the pixel, both for rays from one eye and for parallel rays.
 */
class PatchCoverage
{
public:
  /** Covers a rectangle of `columns` times `rows` pixels. */
  PatchCoverage(const PatchIntersector::FlatHits& hits, int columns, int rows);

  /** Pixels [First, End) of a row. */
  struct Span
  {
    int First;
    int End;
  };
  Span OfRow(int row) const;

private:
  int Columns;
  bool All;
  /**
   * Edge functions: for each edge the value at the first pixel, per column and per row; not
   * negative inside.
   */
  double Edge[3][3];
};

}

#endif
