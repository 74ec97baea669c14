// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Tests of many rays with one box or one patch at once, compiled per instruction set. */
#pragma once

#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RayTubeTree.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/PatchIntersectionBatch.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace meniscus
{

/** Parts of rays in any directions. A ray's point at the depth t is Start + t * Direction. */
struct RayBlock
{
  static constexpr int Size = PatchIntersectionBatch::Size;

  int Count = 0;
  double Start[3][Size];
  double Direction[3][Size];
  /** Reciprocals of the direction's components; of 1e-300 for smaller ones: InvertDirections(). */
  double Inverse[3][Size];
  /** Length of the direction. */
  double Length[Size];
  /** Depths between which the ray is tested. */
  double First[Size];
  double Last[Size];
  /**
   * 1 if the ray only meets surfaces whose normals point along it, -1 if only those whose normals
   * point against it, 0 if it meets both.
   */
  double Facing[Size];
  /** Not 0 if the ray may meet the box or the patch of the latest test. */
  std::int64_t Meets[Size];
  /** Intersection with the facet's plane: see PatchIntersectionBatch. */
  double Depth[Size];
  double X[Size];
  double Y[Size];
  double Slant[Size];
  /** Extremes of beginnings and directions of some rays each: buffers of FindTube(). */
  double Low[6][Size / 8];
  double High[6][Size / 8];

  /** Adds a ray from `first` on, without an end. CompleteRays() has to follow. */
  void Add(const glm::dvec3& start, const glm::dvec3& direction, double first, double facing)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Start[axis][this->Count] = start[axis];
      this->Direction[axis][this->Count] = direction[axis];
    }
    this->First[this->Count] = first;
    this->Last[this->Count] = std::numeric_limits<double>::infinity();
    this->Facing[this->Count] = facing;
    ++this->Count;
  }
  glm::dvec3 GetStart(int i) const
  {
    return { this->Start[0][i], this->Start[1][i], this->Start[2][i] };
  }
  glm::dvec3 GetDirection(int i) const
  {
    return { this->Direction[0][i], this->Direction[1][i], this->Direction[2][i] };
  }
  /** The largest of Last. */
  double GetFarthest() const;
};

/**
 * Computes Length, and repeats the first ray in the lanes behind the last one.
 * @pre GetInstructionSets() has the set; also for the functions that follow
 */
void CompleteRays(InstructionSet set, RayBlock& rays);
/**
 * Bounds of the rays from the depth `first` on, whose parameters are depths. CompleteRays() has to
 * come before, also for the next function.
 */
TubeBounds FindTube(double first, InstructionSet set, RayBlock& rays);
/** The same with directions of unit length. */
TubeBounds FindUnitTube(double first, InstructionSet set, RayBlock& rays);
/** Rays of a block one after another: from First, a multiple of 8, to before End. */
struct RayRange
{
  int First = 0;
  int End = 0;
};

/** Computes Inverse. */
void InvertDirections(InstructionSet set, RayBlock& rays);

/**
 * True if any ray may meet the box; no ray that meets it is missed. Overwrites Meets. Rays are
 * tested in groups up to the first group of which a ray meets the box. InvertDirections() has to
 * come before.
 */
bool MeetsBox(const AxisBox& box, InstructionSet set, RayBlock& rays);

/** Bounds of a patch about the plane of its facet. */
struct PatchReach
{
  FacetPlane Plane;
  /** Length of the plane's normal. */
  double NormalLength;
  /** Bounds of the heights of the patch's points above the plane. */
  double Low;
  double High;
  /** Distance of their feet in the plane from the facet, in barycentric coordinates. */
  double Overhang;
  /** 1 if the patch's normals point to the side of the plane's normal, -1 if to the other side. */
  double Front;
  /** Bound of the difference between the patch's normals and the plane's unit normal times Front.
   */
  double Spread;

  /**
   * False if the ray passes the patch, or meets it at depths outside of [first, last] only.
   * @param meeting its intersection with the plane.
   */
  bool MayMeet(const FacetPlane::Meeting& meeting, const glm::dvec3& direction, double first,
    double last) const
  {
    const double perHeight = this->NormalLength * meeting.Inverse;
    // Depths behind the plane between which the ray is at the heights of the patch.
    const double low = this->Low * perHeight;
    const double high = this->High * perHeight;
    const double begin = std::max(std::min(low, high), first - meeting.Depth);
    const double end = std::min(std::max(low, high), last - meeting.Depth);
    const double byX = glm::dot(this->Plane.ByX, direction);
    const double byY = glm::dot(this->Plane.ByY, direction);
    const double x = meeting.X + std::max(begin * byX, end * byX);
    const double y = meeting.Y + std::max(begin * byY, end * byY);
    const double rest =
      1.0 - meeting.X - meeting.Y - std::min(begin * (byX + byY), end * (byX + byY));
    // The comparisons are written so that a NaN counts as a meeting: the ray is within the plane.
    const bool passes = (x < -this->Overhang) | (y < -this->Overhang) | (rest < -this->Overhang);
    return !(passes | (begin > end));
  }
};

/**
 * Computes Depth, X, Y, Slant and Meets of some rays. Meets is 0 for rays that pass the patch, meet
 * it at depths outside of First and Last only, or meet it from a side that does not count.
 * @pre GetInstructionSets() has the set
 */
void MeetPatchReach(
  const PatchReach& patch, const RayRange& range, InstructionSet set, RayBlock& rays);

}
