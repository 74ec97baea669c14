// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_PatchIntersector_h
#define meniscus_Volume_Refracted_PatchIntersector_h

#include "Refraction/Curved/PatchCrossings.h"
#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Tubes/RayTubeTree.h"
#include "Refraction/Tubes/RefractedRayBounds.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/PatchIntersectionBatch.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace meniscus
{

/** More than rounding can change a distance by, in a view that shows anything of the ball. */
constexpr double SightMargin = 1.0 + 1e-6;

/** The rays at the corners of a rectangle of pixels, in turn around it; directions per depth. */
struct CornerRays
{
  glm::dvec3 Starts[4];
  glm::dvec3 Directions[4];
};

/** What there is to see, before the membrane and behind it. */
struct VisibilityBounds
{
  /** Of a box along the world's axes. */
  glm::dvec3 Center{ 0.0 };
  glm::dvec3 Half{ 0.0 };
  /** n1 / n2, for rays against the normals. */
  double Ratio = 1.0;

  /** Whether the box has a place of the tube. */
  bool Meets(const TubeBounds& tube) const;
  /**
   * Whether rays may come to the box that meet the membrane within `reach` of the hull of `count`
   * points: from the eye to there, or refracted.
   */
  bool MayBeSeen(const DirectionBox& sight, DirectionBox normal, const glm::dvec3* points,
    int count, double reach) const;
};

/** The nearest place where a pixel's ray meets the membrane. */
struct MembraneHit
{
  double Depth = std::numeric_limits<double>::infinity();
  /** 0 where the ray does not matter. */
  glm::dvec3 Normal{ 0.0 };
};

/** Cuts rays with one patch. */
class PatchIntersector
{
public:
  /** What `rays` points at must outlive this. */
  PatchIntersector(const CurvedPatch& patch, const SightRays& rays, InstructionSet set);

  /** Where the rays of a rectangle of pixels meet the plane of the facet. */
  struct FlatHits
  {
    /** Of the rays at the corners. */
    glm::dvec3 Places[4];
    glm::dvec2 Coordinates[4];
    /** Their steps along the facet's normal, positive, if they pass the plane from one side. */
    double Along[4];
    bool FromOneSide;
    /** Of any ray of the rectangle: its length over that along the normal, at most. */
    double Slant;
    /** Rays that meet the patch meet the plane within this of the facet, in its coordinates. */
    double Margin;
  };
  FlatHits MeetPlane(const CornerRays& rays) const;

  /** Whether none of the rays meets the patch. */
  bool IsBeside(const FlatHits& hits) const;
  /** Whether rays that meet the patch may come to the mesh. */
  bool Matters(const FlatHits& hits, const CornerRays& rays, const VisibilityBounds& mesh) const;

  /**
   * Where rays meet the patch; uses up the lanes.
   * @param matters  else nothing of theirs is seen: hits have no normal, and the depth of the
   *                 facet's plane unless they are about its edges.
   * @param visit    called with the index of each ray that does, and the hit.
   */
  template <typename Visit>
  void Meet(bool matters, PatchIntersectionBatch& lanes, const Visit& visit) const;
  /** Rays that touch the patch, or run along it, within rounding; they pass it there. */
  std::int64_t GetNumberOfUndecidedRays() const { return this->UndecidedRays; }

private:
  DirectionBox BoundNormalsOver(const glm::dvec2 (&b)[4], double margin) const;
  void SiftNear(PatchIntersectionBatch& lanes) const;
  /**
   * In barycentric coordinates, between where a ray meets the plane and the place on the patch. A
   * point of the patch lies within the bulge of a point of the facet; the ray through it meets the
   * plane within bulge (1 + slant) of that.
   */
  double MarginOf(double slant) const { return this->Overhang * (1.0 + slant) + Border; }
  template <typename Visit>
  void MeetCurved(bool matters, PatchIntersectionBatch& lanes, const Visit& visit) const;
  bool MayMeetTwice(double slant) const;
  /**
   * Every place where one ray meets the patch: for rays that may meet it twice, and those that
   * Newton's method fails for.
   */
  template <typename Visit>
  void MeetExactly(
    bool matters, const PatchIntersectionBatch& lanes, int lane, const Visit& visit) const;

  /** A ray through an edge meets both of its patches, up to what Newton's method leaves. */
  static constexpr double Border = 1e-8;
  /** Of Newton's method, in facets. What is left is its square times how much a patch bends, below
   * 1e-9: the walk resolves 4e-9 of the mesh. */
  static constexpr double LastStep = 1e-4;
  /** It converges quadratically from a place on the facet, or MeetExactly() takes over. */
  static constexpr int Steps = 12;

  CurvedPatch Patch;
  const SightRays& Rays;
  InstructionSet Set;
  FacetPlane Plane;
  double NormalLength;
  /** What is about as long along a ray as the facet, in depth. */
  double Scale;
  double Bulge;
  double Overhang;
  /** Rays that are no more slanting do not meet the patch twice: a bound, then the best one. */
  mutable double LargestSlant;
  mutable bool IsSlantBest = false;
  mutable std::int64_t UndecidedRays = 0;
  bool IsFlat;
};

//------------------------------------------------------------------------------
template <typename Visit>
void PatchIntersector::Meet(bool matters, PatchIntersectionBatch& lanes, const Visit& visit) const
{
  meniscus::MeetPlane(this->Plane, this->Rays, this->Set, lanes);
  this->SiftNear(lanes);
  const int count = lanes.Count;
  lanes.Count = 0;
  for (int i = 0; i < count; ++i)
  {
    if (!this->IsFlat && (matters || !(lanes.Least[i] > this->MarginOf(lanes.Slant[i]))))
    {
      lanes.Keep(lanes.Count++, i);
      continue;
    }
    const glm::dvec2 b(lanes.X[i], lanes.Y[i]);
    visit(lanes.Index[i],
      MembraneHit{ lanes.Depth[i], matters ? this->Patch.GetNormal(b) : glm::dvec3(0.0) });
  }
  this->MeetCurved(matters, lanes, visit);
}

//------------------------------------------------------------------------------
template <typename Visit>
void PatchIntersector::MeetCurved(
  bool matters, PatchIntersectionBatch& lanes, const Visit& visit) const
{
  const int all = lanes.Count;
  lanes.Count = 0;
  for (int i = 0; i < all; ++i)
  {
    if (!(lanes.Slant[i] <= this->LargestSlant) && this->MayMeetTwice(lanes.Slant[i]))
    {
      this->MeetExactly(matters, lanes, i, visit);
      continue;
    }
    lanes.PatchX[i] = lanes.X[i];
    lanes.PatchY[i] = lanes.Y[i];
    lanes.Behind[i] = 0.0;
    lanes.Keep(lanes.Count++, i);
  }
  for (int step = 0; step < Steps && lanes.Count > 0; ++step)
  {
    StepToPatch(this->Patch, this->Rays, this->Scale, this->Set, lanes);
    const int count = lanes.Count;
    lanes.Count = 0;
    for (int i = 0; i < count; ++i)
    {
      const double outside = FindOutside(glm::dvec2(lanes.PatchX[i], lanes.PatchY[i])).Least;
      if (lanes.Move[i] < LastStep && outside >= -PatchCrossings::Reach)
      {
        if (outside >= -Border)
        {
          const glm::dvec3 normal(lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i]);
          visit(lanes.Index[i],
            MembraneHit{ lanes.Depth[i] + lanes.Behind[i], matters ? normal : glm::dvec3(0.0) });
        }
      }
      // What goes farther than a facet has gone astray. What ends far from the patch, too.
      else if (lanes.Move[i] >= LastStep && std::fabs(lanes.PatchX[i] - lanes.X[i]) <= 1.0 &&
        std::fabs(lanes.PatchY[i] - lanes.Y[i]) <= 1.0 && std::fabs(lanes.Behind[i]) <= this->Scale)
      {
        lanes.Keep(lanes.Count++, i);
      }
      else
      {
        this->MeetExactly(matters, lanes, i, visit);
      }
    }
  }
  for (int i = 0; i < lanes.Count; ++i)
  {
    this->MeetExactly(matters, lanes, i, visit);
  }
  lanes.Count = 0;
}

//------------------------------------------------------------------------------
/** A ray that touches the patch within rounding, which PatchCrossings leaves open, passes it. */
template <typename Visit>
void PatchIntersector::MeetExactly(
  bool matters, const PatchIntersectionBatch& lanes, int lane, const Visit& visit) const
{
  const glm::dvec3 start = this->Rays.StartOf(lanes.Column[lane], lanes.Row[lane]);
  const glm::dvec3 direction = this->Rays.DirectionOf(lanes.Column[lane], lanes.Row[lane]);
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
 * Which of the pixels of a rectangle may meet a patch: which side of an edge a ray passes is the
 * sign of an affine function of the pixel, about one eye or along parallel rays.
 */
class PatchCoverage
{
public:
  /** Of `columns` times `rows` pixels. */
  PatchCoverage(const PatchIntersector::FlatHits& hits, int columns, int rows);

  /** The pixels of a row, [First, End). */
  struct Span
  {
    int First;
    int End;
  };
  Span OfRow(int row) const;

private:
  int Columns;
  bool All;
  /** By edge: at the first pixel, per column and per row; not negative inside. */
  double Edge[3][3];
};

}

#endif
