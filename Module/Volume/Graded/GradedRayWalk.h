// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Walk of rays through a mesh whose index of refraction n bends them: n^2 is linear or quadratic in
 * each cell.
 *
 * Method:
 * 1. The path in a cell is a parabola or a power series (GradedPassage.h). The ray leaves by the
 *    face whose barycentric weight is the first to fall below 0; if several fall at once, by the
 *    face opposite the vertex of the lowest rank.
 * 2. A ray's place is its barycentric weights. They pass to the next cell unchanged, with a weight
 *    of exactly 0 for the vertex that is new, so that no rounding puts a ray outside of its cell.
 *    A ray that has entered by a face moves away from it or along it, never back at once.
 * 3. n^2 is continuous across linked faces, and so is the momentum p, |p| = n.
 * 4. Flat cells are passed in no time, inverted cells backwards, as by straight rays. If the two
 *    sides of a flat cell have different n^2, a jump of the index, Snell's law holds at its plane.
 * 5. Outside of the mesh, rays are straight. They enter it as often as they meet its boundary.
 * After a way through an inverted cell, a ray passes over the faces by which it has entered: it may
 * have come out in front of them, and would go round for ever.
 *
 * A ray can glide along a face to which n^2 rises from both sides, or along an edge. Its zigzag has
 * infinitely many crossings as its height tends to 0. A ray that returns to the same cell in steps
 * that all bend by less than GlideHeight is taken along the face, or along the edge, to the next
 * cell.
 *
 * A ray that enters from outside leaves again, but for a set of measure zero (Poincare's recurrence
 * theorem); its steps are limited all the same.
 */
#pragma once

#include "Simd/InstructionSets.h"
#include "Volume/Graded/BoundaryCones.h"
#include "Volume/Graded/BoundaryCrossings.h"
#include "Volume/Graded/GradedCellTable.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A field in a mesh, and how rays go through it. Everything must outlive the walk. */
struct GradedMedium
{
  const TetrahedralMesh* Mesh = nullptr;
  /** Tree over the mesh's boundary. */
  const BoundaryTree* Tree = nullptr;
  /** Cones of the tree, for quicker searches with the same results; null for none. */
  const BoundaryCones* Cones = nullptr;
  /** Squared index of each vertex; not NaN at active cells. */
  const std::vector<double>* SquaredIndices = nullptr;
  /** Terms of ComputeEdgeTerms(), with which n^2 is quadratic; null for a linear n^2. */
  const std::vector<EdgeTerms>* Terms = nullptr;
  /** Table of the same field, for WalkAll(); null for none. */
  const GradedCellTable* Table = nullptr;
  /**
   * Index outside of the mesh, where Snell's law holds on the boundary. With 0, the index outside
   * equals the index at the boundary everywhere, and rays enter and leave in their directions: the
   * boundary is the end of the data, not of the medium.
   */
  double OutsideIndex = 0.0;
  /**
   * True for rays that go straight, for small angles: OpticalPath is the integral of n along them,
   * and Direction is turned by the integral of grad(n) / n across them. OutsideIndex has no effect.
   */
  bool IsStraight = false;
  /**
   * Largest number of steps of one ray; 0 for four times the number of active cells, at least
   * 65,536. A straight ray crosses each cell at most once. A zigzag of GradedPassage::GlideHeight
   * has about sqrt(|grad(n^2)| / (16 height)) steps per unit of length, 12,000 for a gradient of 1.
   */
  std::int64_t MaximumNumberOfSteps = 0;
};

enum class GradedRayState : std::uint8_t
{
  /** The ray has not met the mesh. */
  Missed,
  /** The ray has left the mesh for good. */
  Left,
  /** The ray was stopped in the mesh after the largest number of steps. */
  Trapped,
  /** The ray has no way out of a cell, which only numbers that are not finite can bring about. */
  Lost,
  /** A visitor has ended the ray. Only its entry, if it has one, is set. */
  Ended
};

/** A ray of light. */
struct GradedRay
{
  /** Relative to the mesh's centre, in units of its radius. */
  glm::dvec3 Origin{ 0.0 };
  /** Any length but 0. */
  glm::dvec3 Direction{ 0.0 };
};

/** Result of a ray. Positions are relative to the mesh's centre, in units of its radius. */
struct GradedRayResult
{
  GradedRayState State = GradedRayState::Missed;
  /** Place at which the ray first entered the mesh; its origin if it began or stayed outside. */
  glm::dvec3 Entry{ 0.0 };
  /** Place at which it last left the mesh or was stopped. */
  glm::dvec3 Exit{ 0.0 };
  /** Direction after that; unit length. */
  glm::dvec3 Direction{ 0.0 };
  /** Integral of n along the path from Entry to Exit, in units of the radius. */
  double OpticalPath = 0.0;
};

/** Sums over rays. */
struct GradedRayStatistics
{
  /** Rays that met the mesh. */
  std::int64_t Rays = 0;
  std::int64_t Steps = 0;
  /** Steps of rays in lanes, which are among all steps. */
  std::int64_t LaneSteps = 0;
  /** Total reflections at the boundary. */
  std::int64_t Reflections = 0;
  /** Steps along a face or an edge; steps in flat and inverted cells. */
  std::int64_t Glides = 0;
  std::int64_t FlatSteps = 0;
  std::int64_t InvertedSteps = 0;
  std::int64_t Trapped = 0;
  /** Trapped rays that have passed inverted cells, in which light goes backwards. */
  std::int64_t TrappedInFolds = 0;
  std::int64_t Lost = 0;

  void Add(const GradedRayStatistics& other);
};

class GradedPassage;
class GradedRayVisitor;

/** Visitors of many rays that need not know of all cells. */
struct GradedWatch
{
  /** Visitor of each ray. */
  std::vector<GradedRayVisitor*> Visitors;
  /** Nonzero for each cell whose arcs are passed to the visitors. Legs are always passed. */
  const std::vector<std::uint8_t>* Cells = nullptr;
};

class GradedRayWalk
{
public:
  explicit GradedRayWalk(const GradedMedium& medium);

  /**
   * Follows a ray until it has left the mesh for good. It may begin inside of the mesh.
   * @param origin relative to the mesh's centre, in units of its radius.
   * @param direction any length but 0.
   */
  GradedRayResult Walk(
    const glm::dvec3& origin, const glm::dvec3& direction, GradedRayStatistics& statistics) const;

  /** Follows a ray like Walk() and tells a visitor of the pieces of its path (GradedPiece.h). */
  GradedRayResult Follow(
    const GradedRay& ray, GradedRayStatistics& statistics, GradedRayVisitor& visitor) const;

  /**
   * Follows many rays, several at a time if the medium has a table. The results do not depend on
   * the other rays, and differ from the results of Walk() by rounding.
   * @param results one per ray; replaced.
   * @param set instruction set, on which the results do not depend.
   * @param faces by which the rays may enter first, for quicker searches with the same results;
   *   null for none.
   * @param watch visitors of the rays; null for none.
   */
  void WalkAll(const std::vector<GradedRay>& rays, GradedRayStatistics& statistics,
    GradedRayResult* results, InstructionSet set = BestInstructionSet(),
    const EntryFaces* faces = nullptr, const GradedWatch* watch = nullptr) const;

private:
  struct Path;
  class LaneWalk;

  GradedRayResult WalkToEnd(
    const GradedRay& ray, GradedRayStatistics& statistics, Path& path) const;
  bool Begin(const GradedRay& ray, GradedRayResult& result, GradedRayStatistics& statistics,
    Path& path) const;
  bool TellArc(GradedPassage& way, double time, const std::array<double, 4>& end,
    double opticalPath, const Path& path) const;
  void Finish(Path& path) const;
  bool MayBeInside(const glm::dvec3& place) const;
  bool BeginInside(Path& path) const;
  bool EnterMesh(Path& path) const;
  BoundaryCrossing FindEntry(Path& path) const;
  void PutIn(const BoundaryCrossing& crossing, Path& path) const;
  bool Advance(Path& path) const;
  void PassTo(std::int32_t link, int face, Path& path) const;
  bool LeaveMesh(int face, Path& path) const;
  int CrossCell(Path& path) const;
  void WatchForZigzag(Path& path) const;
  const TetrahedralMesh::Cell& CellOf(const Path& path) const;
  double SquaredIndexAt(const Path& path) const;
  glm::dvec3 PlaceOf(const Path& path) const;
  glm::dvec3 PlaceIn(std::int64_t cell, const std::array<double, 4>& weights) const;
  glm::dvec3 OutwardNormal(std::int64_t cell, int face) const;

  GradedMedium Medium;
  BoundaryCrossings Crossings;
  std::int64_t MaximumNumberOfSteps;
};

}
