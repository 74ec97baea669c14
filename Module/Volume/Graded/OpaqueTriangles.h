// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Volume/Graded/GradedPiece.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/VolumeLight.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Place of a triangle that a ray meets. */
struct OpaqueHit
{
  /** Number of the triangle; -1 for none. */
  std::int32_t Triangle = -1;
  glm::dvec3 Place{ 0.0 };
  /** Direction of the ray there; unit length. */
  glm::dvec3 Direction{ 0.0 };
  /** Barycentric weights of the triangle's corners. */
  std::array<double, 3> Weights{};
  /** True if the ray meets the side about which the corners turn to the left. */
  bool IsFront = false;
  /** Share of the time of the arc on which it is met, from 0 to 1; 0 outside of the mesh. */
  double Share = 0.0;
};

/**
 * Triangles that bent rays end at.
 *
 * An arc is divided into halves until its distance from its chord is below the rounding of places;
 * parts are left out whose distance from the chord cannot bring them to the box of a triangle. No
 * triangle is missed, whatever the size of the cells. Chords of neighbouring parts share an end,
 * and no line passes between triangles at an edge.
 */
class OpaqueTriangles
{
public:
  /** @param points in the units of the walk, finite; triangles by numbers of points. */
  void Build(
    std::vector<glm::dvec3> points, const std::vector<std::array<std::int32_t, 3>>& triangles);

  bool IsEmpty() const { return this->Triangles.empty(); }
  /** Box around all triangles. */
  const AxisBox& GetBounds() const { return this->Bounds; }

  /** Find the first triangle on a piece of a path; of equally near ones the lowest number. */
  bool Meet(const GradedLeg& leg, OpaqueHit& hit) const;
  bool Meet(GradedArc& arc, OpaqueHit& hit) const;

  /** By cell of a mesh, whether a triangle may be in it: MayHaveTriangle or 0. */
  std::vector<std::uint8_t> FindCells(
    const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop) const;

private:
  struct Chord;
  bool MeetPart(GradedArc& arc, const Chord& chord, double from, double to, OpaqueHit& hit) const;
  bool MeetLine(const Chord& chord, OpaqueHit& hit) const;
  bool MayMeet(const Chord& chord, double height) const;
  bool MayBeIn(const std::array<glm::dvec3, 4>& cell) const;

  std::vector<glm::dvec3> Points;
  std::vector<std::array<std::int32_t, 3>> Triangles;
  AxisBox Bounds;
  BoxTree Tree;
};

/** Object that a ray of light comes from. */
struct OpaqueSight
{
  /** Triangle that the ray ends at. */
  OpaqueHit Hit;
  /** Direction at its end; unit length. */
  glm::dvec3 Direction{ 0.0 };
  /** True if the ray stayed in the mesh and was stopped or lost. */
  bool IsStopped = false;
  /** Light of the medium in front of it. */
  KeptLight Light;
};

/** Flags of the cells in which rays are watched. */
enum WatchedCell : std::uint8_t
{
  /** A triangle may be in the cell: OpaqueTriangles::FindCells(). */
  MayHaveTriangle = 1,
  /** Something is seen of an emitting medium, and its scalars are finite. */
  HasLight = 2
};

/**
 * Follows rays until they meet a triangle.
 * @param cells flags of WatchedCell; null if no triangle is in the box around the mesh and there is
 *   no medium that emits light, where rays need not be watched.
 * @param results one per ray; replaced.
 * @param faces as for GradedRayWalk::WalkAll().
 * @param medium that emits and absorbs light in front of the triangles; null for none.
 */
void SeeTriangles(const GradedRayWalk& walk, const OpaqueTriangles& triangles,
  const std::vector<std::uint8_t>* cells, const std::vector<GradedRay>& rays,
  GradedRayStatistics& statistics, OpaqueSight* results, const EntryFaces* faces = nullptr,
  const EmittingMedium* medium = nullptr);

/** Ends a ray at the first triangle. */
class OpaqueVisitor : public GradedRayVisitor
{
public:
  explicit OpaqueVisitor(const OpaqueTriangles& triangles)
    : Triangles(triangles)
  {
  }

  bool VisitLeg(const GradedLeg& leg) override { return !this->Triangles.Meet(leg, this->Hit); }
  bool VisitArc(GradedArc& arc) override { return !this->Triangles.Meet(arc, this->Hit); }

  /** The first triangle that was met. */
  OpaqueHit Hit;

private:
  const OpaqueTriangles& Triangles;
};

}
