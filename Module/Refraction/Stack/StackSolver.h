// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Virtual vertices behind several refracting surfaces: for an eye and a point, the sight points on
 * all interfaces between them. The interface takes world coordinates.
 *
 * Method: shooting. The unknowns are the two coordinates of the first sight point, however many
 * interfaces follow; the ray is traced through all of them, and Newton's method drives the distance
 * between the point and the last ray to zero, with the derivatives of the traced ray. In contrast
 * to a joint iteration for all sight points, every iterate is a physical path: it obeys Snell's law
 * at each interface, takes the nearest crossing with each surface, and cannot converge to points in
 * the wrong order. The next answer along a chain of points is predicted by the same derivatives.
 * First guesses come from trees of ray tubes, one per number of interfaces passed: bounds of the
 * rays that a patch of the first surface sends behind that interface.
 *
 * The virtual vertex is on the sight ray, behind the first sight point by n0 times the sum of the
 * lengths of the legs behind it, each over the index of its medium. This is Eq. 2.4 for every leg.
 *
 * A point may lie behind all interfaces, or between two of them. It is seen through the first k
 * interfaces if the ray behind them reaches it before interface k + 1, and meets that interface
 * afterwards: points whose rays would miss a later interface are not seen through the stack. A
 * point in front of all of them is its own image if the straight ray through it goes on to the
 * first one.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Sight/VirtualVertex.h"
#include "Refraction/Stack/ParallelPlanes.h"
#include "Refraction/Stack/StackBeams.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace meniscus
{

/** Properties of an image that only several interfaces have. */
struct StackDetail
{
  glm::dvec3 LastSightPoint{ 0.0 }; ///< on the last interface in front of the point
  double Transmittance = 1.0;       ///< of the interfaces in front of it: PlateTransmittance
  std::int32_t Passed = 0;          ///< number of interfaces in front of the point
};

/** Places that StackSolver::Solve writes the images of points to. */
struct ImageOutput
{
  VirtualVertex* Vertices;
  StackDetail* Details;     ///< null if they are not wanted
  double* Legs;             ///< one per interface and point; null with null details
  std::size_t LegsPerPoint; ///< number of interfaces, including interfaces behind the eye
};

/** Image of a point through a stack; SightPoint and Facet are on the first interface. */
struct StackVertex
  : VirtualVertex
  , StackDetail
{
};

class StackSolver
{
public:
  /** Number of points that share a chain of warm starts, as CurvedMembraneSolver::Chain. */
  static constexpr std::size_t Chain = 128;

  /** Sets the interfaces. The eye must be set again afterwards. */
  MediaChain SetInterfaces(const std::vector<Interface>& list);

  /**
   * Sets an eye, and fits the beams to it unless the surfaces are exact parallel planes, which
   * hardly ever need them. Solving is allowed only if the result is `Ready`.
   */
  EyeStatus SetEye(const glm::dvec3& eye, const RangeLoop& loop = SerialLoop);

  /** Sets the eye of GetStack() alone, for rays that are traced through it. */
  EyeStatus PlaceEye(const glm::dvec3& eye) { return this->Stack.SetEye(eye); }

  const RefractionStack& GetStack() const { return this->Stack; }

  /**
   * Finds one image of each of `points` (x, y, z each) in [begin, end), and writes it to the same
   * places of `vertices` and `details`. `legs` gets the lengths of the legs behind each interface
   * of the list that refracts, GetStack().GetNumberOfInterfaces() per point, 0 for those not
   * passed. If a point has several images, the result continues the previous point's image.
   */
  void Solve(const double* points, std::size_t begin, std::size_t end, VirtualVertex* vertices,
    StackDetail* details, double* legs) const;

  /**
   * Solves those points of a chain whose images exact parallel planes decide, as Solve does: points
   * behind all of them. The numbers of the others are appended to `others`.
   */
  void SolveBehindPlanes(const double* points, std::size_t begin, std::size_t end,
    const ImageOutput& output, std::vector<std::size_t>& others) const;

  /** State of a chain of points: the path of the last answer, and the step that led to it. */
  struct Memory
  {
    StackPath Path; ///< without points if there is none
    glm::dvec3 Point{ 0.0 };
    glm::dvec3 Step{ 0.0 }; ///< of the points; 0 after a search
    /** Changes of the sight points at this step, to first order. */
    std::vector<glm::dvec3> Changes;
    std::vector<HeldPatch> Held; ///< one per interface, or none
    StackPath Next;              ///< kept so that its memory is reused
  };

  /**
   * One image of a point, as Solve finds it after the points recorded in `memory`. If it passes
   * interfaces, `memory` has its path afterwards.
   */
  StackVertex SolvePoint(const glm::dvec3& point, Memory& memory) const;

  /**
   * Replaces `images` by the paths of all images of a point, at most one of which is the straight
   * one, without interfaces. Those that pass more interfaces come first, then they are in the order
   * of their facets. An image is a path along the list with the point on one of its legs. Returns
   * `Found` if there are any.
   */
  ImageState FindImages(const glm::dvec3& point, std::vector<StackPath>& images) const;
  /**
   * As above, but where a point is known to have one image at most, the search begins at the image
   * of the point before it, as in SolvePoint.
   */
  ImageState FindImages(
    const glm::dvec3& point, Memory& memory, std::vector<StackPath>& images) const;

  /** The vertex of a point in world coordinates that a path leads to. */
  StackVertex MakeVertex(const glm::dvec3& point, const StackPath& path) const
  {
    return path.Count == 0 ? this->PassThrough(point)
                           : this->MakeRefracted(point - this->Stack.GetOrigin(), path);
  }

  /** Beams of the patches, fitted to the eye at the first call unless SetEye has done so. */
  const StackBeams& GetBeams() const { return this->PrepareBeams(SerialLoop); }
  /** The surfaces, if they are parallel planes; otherwise empty. */
  const ParallelPlanes& GetPlanes() const { return this->Planes; }
  bool IsInReach(const glm::dvec3& local) const;

  /**
   * Traces the path of a known sight point in world coordinates, in the patch of `facet`, through
   * at most `count` interfaces. The search begins at the places of an earlier path.
   */
  void Retrace(
    const glm::dvec3& sightPoint, std::int32_t facet, std::size_t count, StackPath& path) const;

  /**
   * Writes the lengths of the legs of a path to a point, as Solve does;
   * GetStack().GetNumberOfInterfaces() values.
   */
  void MeasureLegs(const glm::dvec3& point, const StackPath& path, double* legs) const;

  /**
   * Number of searches since construction that found no image, or not all of them, although some
   * part of a patch could be neither excluded nor traced far enough: at caustics, critical angles
   * and borders.
   */
  std::int64_t GetNumberOfUndecidedSearches() const { return this->Undecided; }
  /** Counts another one, of a user of this object. */
  void CountUndecided() const { ++this->Undecided; }

  /** Number of parts of cells since construction that were left out and are too narrow to be seen.
   */
  std::int64_t GetNumberOfNarrowParts() const { return this->NarrowParts; }
  void CountNarrowPart() const { ++this->NarrowParts; }

private:
  void SolveChain(
    const double* points, std::size_t begin, std::size_t end, const ImageOutput& output) const;
  const StackBeams& PrepareBeams(const RangeLoop& loop) const;
  void BoundLegs();
  bool NeedsSearch(const glm::dvec3& local) const;
  bool MayBeOnLeg(const glm::dvec3& local, std::size_t count) const;
  bool Follow(const glm::dvec3& local, Memory& memory) const;
  bool FindBehindPlanes(const glm::dvec3& local, StackPath& path) const;
  bool FindFirst(const StackTarget& target, StackPath& path) const;
  StackVertex MakeRefracted(const glm::dvec3& local, const StackPath& path) const;
  StackVertex PassThrough(const glm::dvec3& point) const;

  RefractionStack Stack;
  mutable StackBeams Beams;
  mutable std::unique_ptr<std::once_flag> BeamsOnce = std::make_unique<std::once_flag>();
  ParallelPlanes Planes;
  std::vector<AxisBox> LegBoxes; ///< of all legs between two interfaces
  mutable std::atomic<std::int64_t> Undecided{ 0 };
  mutable std::atomic<std::int64_t> NarrowParts{ 0 };
};

}
