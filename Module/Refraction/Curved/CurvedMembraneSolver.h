// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Virtual vertices behind a membrane of curved patches: a refracting surface, a tree of ray tubes
 * over its patches, and Newton's method on Snell's law. The interface takes world coordinates;
 * members use local ones, relative to the membrane's origin.
 *
 * The patches stay valid until the shape changes, the bounds in the tree until the eye or the
 * indices change. Solving changes no state and may run on any number of threads at once.
 */
#pragma once

#include "Refraction/Curved/InjectivityGrid.h"
#include "Refraction/Curved/MembraneSides.h"
#include "Refraction/Curved/SightFollower.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Sight/EyeStatus.h"
#include "Refraction/Sight/SightEquation.h"
#include "Refraction/Sight/VirtualVertex.h"
#include "Refraction/Surface/CurveCrossings.h"
#include "Refraction/Surface/RefractingSurface.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace meniscus
{

class CurvedMembraneSolver
{
public:
  CurvedMembraneSolver() = default;
  CurvedMembraneSolver(const CurvedMembraneSolver&) = delete;
  CurvedMembraneSolver& operator=(const CurvedMembraneSolver&) = delete;

  /**
   * Number of points that share a chain of warm starts. Ranges that begin and end at multiples of
   * it give the same result whichever thread solves them.
   */
  static constexpr std::size_t Chain = 128;

  /** Number of chains that are solved side by side, if a range has so many. */
  static constexpr std::size_t ChainsAtOnce = 16;

  /**
   * Sets the surface, whose patches are ready. Needed again after each change of its shape. The
   * tree keeps its topology as long as the facets stay the same. The eye must be set again
   * afterwards.
   */
  void SetSurface(const std::shared_ptr<const RefractingSurface>& surface);
  /** Sets the shape of a surface of the solver's own. */
  MembraneStatus SetMembrane(const MembraneInput& input, const RangeLoop& loop = SerialLoop);

  /** Removes the membrane. */
  void Clear();

  const Membrane& GetMembrane() const { return this->Surface->GetMembrane(); }
  const CurvedPatches& GetPatches() const { return this->Surface->GetPatches(); }
  /** Tree over the refracted rays of all facets, fitted to the eye at the first call. */
  const RayTubeTree& GetTree() const
  {
    this->PrepareTree(SerialLoop);
    return this->Tree;
  }
  void PrepareTree(const RangeLoop& loop) const;

  /**
   * Sets an eye in world coordinates, and fits the tree to it. Solving is allowed only if the
   * result is `Ready`. With `reflects`, the membrane is a mirror: virtual points belong to points
   * on the eye's side and are as far behind their sight points as the points are in front of them.
   * The indices give the reflectance only.
   */
  EyeStatus SetEye(const glm::dvec3& eye, double exterior, double interior,
    const RangeLoop& loop = SerialLoop, bool reflects = false);
  /**
   * Sets an eye that is not on the membrane, for a surface that refracts and hardly needs the tree.
   */
  EyeStatus PlaceEye(const glm::dvec3& eye, double exterior, double interior);

  /**
   * Finds one image of each of `points` (x, y, z each) in [begin, end) and writes it to the same
   * places of `vertices`. If a point has several images, the result continues the previous point's
   * image; at the start of a chain, and where this continuation ends, it is the first image that
   * the tree yields. If a continuation ended at a step, later steps of the chain that are more than
   * 1.1 times as long are not continued. With `isAsked`, which has a value for each point, points
   * with 0 are left out of their chains.
   */
  void Solve(const double* points, std::size_t begin, std::size_t end, VirtualVertex* vertices,
    const unsigned char* isAsked = nullptr) const;

  /**
   * Replaces `images` by all images of a point, in the order of their facets. Returns `Found` if
   * there are any.
   */
  ImageState FindImages(const glm::dvec3& point, std::vector<VirtualVertex>& images) const;

  /**
   * Number of searches since construction for all images of a point that may have missed some: at
   * a focus, where images are not isolated, or too close to a caustic for Newton's method.
   */
  std::int64_t GetNumberOfUndecidedSearches() const { return this->UndecidedSearches; }

  /** State of a chain of points: the last answer and its steps from the answer before it. */
  struct Memory
  {
    SightPlace Place;
    glm::dvec3 Point{ 0.0 };
    glm::dvec3 PointStep{ 0.0 };
    glm::dvec3 SightStep{ 0.0 };
    /** Change of SightStep since the previous step, and whether that predicts the next change. */
    glm::dvec3 SightTurn{ 0.0 };
    bool IsTurning = false;
    /** Difference of the facets' numbers. */
    std::int32_t FacetStep = 0;
    /** Square of the shortest step so far that could not be continued. */
    double FailedStep = std::numeric_limits<double>::infinity();
  };

  /** One image of a point, as Solve finds it after the points that are recorded in `memory`. */
  VirtualVertex SolvePoint(const glm::dvec3& point, Memory& memory) const;

  /** @{ */
  /**
   * The directions that InjectivityGrid takes, along the mean of the membrane's normals, or against
   * it if the membrane reflects, and whether the membrane is a convex field along them, which
   * PrepareField determines once per shape.
   */
  void PrepareField();
  const HeightFrame& GetFrame() const { return this->RayFrame; }
  bool HasConvexField() const { return this->ConvexField; }
  /** @} */
  /**
   * Grid for points down to the height `lowest` along GetFrame(), in local coordinates. It reaches
   * from the top of the membrane down by its radius, multiplied by a power of two. Objects in
   * similar depths therefore share a grid, which does not depend on their order. It is kept until
   * the shape or the eye changes. Needs PrepareField.
   */
  const InjectivityGrid& PrepareGrid(double lowest, const RangeLoop& loop);
  /** Largest distance of a patch from its flat facet. */
  double GetLargestBulge() const { return this->LargestBulge; }

  /**
   * Image of a point that continues a known image of a nearby point, or two images of points on
   * both sides of it; NoImage if Newton's method does not converge to one.
   */
  VirtualVertex SolveNear(const glm::dvec3& point, const VirtualVertex& known) const
  {
    return this->SolveBetween(point, known, known);
  }
  VirtualVertex SolveBetween(
    const glm::dvec3& point, const VirtualVertex& first, const VirtualVertex& second) const;

  /** A point between two images, and where its image is to be written. */
  struct PointBetween
  {
    glm::dvec3 Point;
    const VirtualVertex* First;
    const VirtualVertex* Second;
    VirtualVertex* Image;
  };
  /** Number of points that are solved between images at once. */
  static constexpr std::size_t MostBetween = 2 * SightLanes::Count;
  /** SolveBetween for at most MostBetween points, side by side and with the same results. */
  void SolveAllBetween(const PointBetween* points, std::size_t count) const;

  /** True if the eye is in front of the surface at any vertex. */
  bool FacesEye() const;
  /**
   * Number of vertices that the eye sees, from their front, through another piece of the membrane;
   * at most `most` vertices are examined. Sight rays to them meet both pieces, one after the other.
   */
  std::size_t CountVerticesBehindOtherPieces(std::size_t most) const;

  /**
   * Intersection of a line in local coordinates with the membrane near the place `b` in the patch
   * of `facet` and near the line's parameter `l`. The search crosses edges to neighbouring patches
   * as they are seen along `seenAlong`. Returns false if it finds none.
   */
  bool MeetLine(const ObjectLine& line, const glm::dvec3& seenAlong, std::int32_t& facet,
    glm::dvec2& b, double& l) const;

  /** Eye and indices, in local coordinates: relative to the membrane's origin. */
  const Media& GetMedia() const { return this->Optics; }
  SightEquation MakeEquation(const glm::dvec3& local) const
  {
    return this->Optics.MakeEquation(local);
  }
  bool IsInReach(const glm::dvec3& local) const
  {
    return RayTubeTree::IsInReach(local, this->GetMembrane().GetRadius());
  }

  /**
   * Calls `visit(facet)` for every facet that may show a point of the box with centre `local` and
   * half sides `padding`.
   */
  template <typename Visitor>
  void VisitFacets(const glm::dvec3& local, const glm::dvec3& padding, Visitor&& visit) const
  {
    this->GetTree().Visit(local, padding,
      [&visit](std::int32_t facet)
      {
        visit(facet);
        return std::numeric_limits<std::int32_t>::max();
      });
  }

  /**
   * True if a patch that `chosen` marks may show a point of the box from `low` to `high`, in world
   * coordinates, or if points of the box may be shown unrefracted: unless the box is entirely
   * behind the membrane, or the membrane reflects.
   */
  bool MayShow(
    const glm::dvec3& low, const glm::dvec3& high, const std::vector<bool>& chosen) const;

  /** The virtual vertex of a local point with the sight point `place`. */
  VirtualVertex MakeVertex(
    const glm::dvec3& local, const CurvedPatch& patch, const SightPlace& place) const
  {
    return this->GetFollower().MakeVertex(local, patch, place);
  }

  /**
   * Virtual vertex of a local point that is its own image: on the eye's side of a membrane that
   * refracts, or on a mirror.
   */
  VirtualVertex PassThrough(const glm::dvec3& local) const;

  /** @{ */
  /**
   * Tests for the eye's side of the membrane. Along an axis, the mean of the membrane's normals, it
   * is a height field unless it overhangs: a point is in front if the nearest patch below it along
   * the axis faces it, or if it lies on a patch within rounding. Beyond the border, a point that is
   * above the whole membrane is in front. IsBehindAll is a first test at almost no cost; where it
   * fails, IsInFront needs PrepareSides, a tree over the facets' columns that is built once per
   * shape.
   *
   * For a closed membrane the axis is a fixed direction that is parallel to no face of boxes and
   * cylinders aligned with the coordinate axes. A point without a patch below it is outside, which
   * is in front if the normals point outwards.
   */
  void PrepareSides();
  bool IsBehindAll(const glm::dvec3& local) const
  {
    return !this->OutsideIsFront && glm::dot(this->Axis, local) < this->Lowest;
  }
  bool IsClosed() const { return this->Closed; }
  /** True if the membrane deviates from a plane by the rounding of its coordinates at most. */
  bool IsFlat() const;
  bool IsInFront(const glm::dvec3& local) const;
  /**
   * True if `count` points (x, y, z each), in world coordinates, are certainly on the side of the
   * membrane that its rays go to: behind all of it, or in front of all of it if it reflects.
   */
  bool AreAllOnRaySide(const double* points, std::size_t count) const;
  /** True if a point may lie on a ray that has not met the membrane again. Needs PrepareSides. */
  bool IsOnRaySide(const glm::dvec3& local) const
  {
    return this->Optics.Reflects ? this->FindSideOfMirror(local) != MembraneSides::Side::Behind
                                 : !this->IsInFront(local);
  }
  /**
   * Number of points since construction whose side could not be determined; they are not in front.
   */
  std::int64_t GetNumberOfUndecidedSides() const
  {
    return this->Sides.GetNumberOfUndecided() + this->SidesAbove.GetNumberOfUndecided();
  }
  /** @} */

private:
  void FindAxis();
  void FindEnclosure();
  bool IsAboveAll(const glm::dvec3& local) const
  {
    return !this->Closed && glm::dot(this->Axis, local) > this->Highest;
  }
  MembraneSides::Side FindSideOfMirror(const glm::dvec3& local) const;
  bool FindOnMirror(const glm::dvec3& local, VirtualVertex& vertex) const;
  void BuildTree();
  bool IsEyeOnPatch(const CurvedPatch& patch) const;
  SightFollower GetFollower() const
  {
    return { this->GetPatches(), this->Optics, this->GetMembrane().GetOrigin(), this->Set };
  }
  void SolveChains(const double* points, std::size_t begin, std::size_t end,
    VirtualVertex* vertices, const unsigned char* isAsked) const;
  bool Begin(const glm::dvec3& point, const Memory& memory, SightTrail& trail) const;
  bool BeginBetween(const glm::dvec3& point, const VirtualVertex& first,
    const VirtualVertex& second, SightTrail& trail) const;
  void Finish(const glm::dvec3& point, SightTrail& trail, Memory& memory) const;
  bool FindFirst(const SightEquation& equation, const glm::dvec3& local, SightPlace& place) const;
  void FindPlaces(
    const SightEquation& equation, const glm::dvec3& local, std::vector<SightPlace>& places) const;

  std::shared_ptr<const RefractingSurface> Surface = std::make_shared<RefractingSurface>();
  std::shared_ptr<RefractingSurface> Own; ///< surface of SetMembrane()
  /** Fitted when it is needed. */
  mutable RayTubeTree Tree;
  mutable std::atomic<bool> Touched{ false }; ///< the eye of the tree is on a patch
  std::unique_ptr<std::once_flag> TreeOnce = std::make_unique<std::once_flag>();
  std::int64_t TreeOf = -1; ///< topology of the surface that the tree was built for
  MembraneSides Sides;
  MembraneSides SidesAbove; ///< as Sides, but by patches above points
  bool SidesReady = false;
  bool SidesAboveReady = false;
  glm::dvec3 Axis{ 0.0 };
  HeightFrame Frame;
  HeightFrame RayFrame;
  bool FieldReady = false;
  bool ConvexField = false;
  std::map<int, InjectivityGrid> Grids; ///< by the exponent of the depth
  double LargestBulge = 0.0;
  double Lowest = 0.0;
  double Highest = 0.0;
  bool Closed = false;
  bool OutsideIsFront = false; ///< the membrane is closed and its normals point outwards
  Media Optics{ glm::dvec3(0.0), 1.0, 1.0 };
  InstructionSet Set = BestInstructionSet();
  mutable std::atomic<std::int64_t> UndecidedSearches{ 0 };
};

}
