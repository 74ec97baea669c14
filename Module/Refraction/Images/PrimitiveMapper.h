// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * All images of a triangle or a line, computed from the membrane.
 *
 * Each patch that may show the primitive is divided into triangular sub-cells so fine that its rays
 * are nearly linear in each of them. The rays at the corners of a sub-cell meet the primitive's
 * plane in a polygon, which is clipped by the primitive; every corner of the clipped polygon is an
 * image. Pieces meet bit by bit, but for gaps that SeamClosure closes:
 * Documentation/refraction-method.md, "Lines and polygons".
 */
#pragma once

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/KnownMeetings.h"
#include "Refraction/Images/ObjectPrimitive.h"
#include "Refraction/Images/PiecePoints.h"
#include "Refraction/Images/SubCellBend.h"
#include "Refraction/Images/SubCellDivision.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace meniscus
{

/** A point of a triangle in barycentric and in world coordinates. */
struct TrianglePoint
{
  glm::dvec3 Weight;
  glm::dvec3 Position;
};

/**
 * Straight piece of the curve along which a triangle meets the membrane. With respect to the
 * triangle's winding, the part behind the membrane is on its left.
 */
struct WaterlinePiece
{
  TrianglePoint From;
  TrianglePoint To;
};

class PrimitiveMapper
{
public:
  /**
   * `tolerance` is the largest error of linear interpolation in a sub-cell, as an angle in radians
   * at the eye, at the distances `nearest` and `farthest` behind the membrane. `shared` has the
   * nodes of mappers with the same parameters.
   */
  PrimitiveMapper(const CurvedMembraneSolver& geometry, double tolerance, double nearest,
    double farthest, SharedNodes& shared);

  /**
   * Adds the images of a triangle as convex polygons with the winding of the triangle. With
   * `mayCross`, also adds the part of it in front of the membrane, unchanged, unless it reflects.
   */
  void MapTriangle(const MappedTriangle& triangle, std::int64_t sourceCell, bool mayCross,
    ImageMesh& images) const;

  /** Adds the images of a line between the first two corners as lines of two points. */
  void MapLine(
    const MappedTriangle& line, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const;

private:
  struct Corner;
  struct Context;
  using Polygon = std::vector<Corner>;
  enum class Finding
  {
    Found,
    EndWithoutImage, ///< an end of the primitive without an image in or next to the sub-cell
    InFront,         ///< an end that is in front of the membrane
    Elsewhere ///< a side that does not meet the membrane there, or an end that is seen elsewhere
  };
  struct MappedPoint
  {
    ImagePoint Point;
    Finding Outcome;
  };

  /** Ray from a side of a sub-cell that meets a side of the primitive. */
  struct Meeting
  {
    RefractedPoint From;
    double Place; ///< on the side of the sub-cell, from 0 to 1
    bool IsKnown = false;
  };
  /** By side of the sub-cell and side of the primitive. */
  using Meetings = std::array<Meeting, 9>;
  /** Place of a ray in the primitive's plane, and the constraints between which it meets it. */
  struct EdgeOn
  {
    glm::dvec2 B;
    std::array<unsigned, 2> Limits;
    bool IsThere = false;
    bool IsMet = false; ///< the ray meets the primitive behind the membrane
  };

  void MapSides(Context& context, bool mayCross, ImageMesh& images) const;
  bool MapAsBehind(Context& context, ImageMesh& images) const;
  void Map(const Context& context) const;
  std::vector<WaterlinePiece> DropBeyond(
    const Context& context, const ImageMesh& from, ImageMesh& images) const;
  double GetLengthInFront(const Context& context) const;
  double GetReach(const SubCell& nodes) const;
  bool IsInFront(const SubCell& nodes, const RefractedPoint& from, const glm::dvec3& place) const;
  bool IsOutside(const Context& context, std::optional<PatchBend>& patchBend, const SubCell& nodes,
    double inFront) const;
  void MapSubCell(const Context& context, const SubCell& nodes) const;
  void KeepAsBehind(const Context& context, const SubCell& nodes, const Polygon& whole, double sign,
    Polygon& polygon) const;
  bool ResolveTie(const Context& context, const SubCell& nodes, Polygon& whole) const;
  static bool IsBeyond(const Context& context, const Polygon& whole, double sign);
  bool OrderCrossings(const Context& context, const SubCell& nodes, Polygon& whole) const;
  void Emit(const Context& context, const SubCell& nodes, Polygon polygon, double sign,
    bool isLinear) const;
  double GetSlope(const Context& context, const std::vector<MappedPoint>& points) const;
  bool CutAtMembrane(const Context& context, const SubCell& nodes, const Polygon& whole,
    double sign, const EdgeOn& edgeOn, Polygon& polygon) const;
  static void DropUnmetEnds(Polygon& polygon);
  void Locate(const Context& context, const SubCell& nodes, Corner& corner) const;
  double GetDistance(const Context& context, const SubCell& nodes, std::size_t end) const;
  const Meeting& FindMeeting(
    const Context& context, const SubCell& nodes, int edge, int side) const;
  RefractedPoint FindRay(const Context& context, const SubCell& nodes, const Corner& corner,
    const ClippedBoundary& on) const;
  bool SolveEnd(
    const Context& context, const SubCell& nodes, std::size_t end, PatchPoint& at) const;
  void EmitLine(const Context& context, const SubCell& nodes, const Polygon& polygon) const;
  MappedPoint MakePoint(const Context& context, const SubCell& nodes, const Corner& corner) const;
  MappedPoint MakeEnd(const Context& context, const SubCell& nodes, glm::length_t end,
    const glm::dvec2& interpolated, bool isOnMembrane = false) const;
  MappedPoint MakeOnSide(const Context& context, const SubCell& nodes, std::size_t side,
    const RefractedPoint& from, const glm::dvec2& interpolated) const;
  MappedPoint MakeCrossing(const Context& context, const SubCell& nodes, const Corner& corner,
    const ClippedBoundary& on) const;
  MappedPoint MakeSideCrossing(const Context& context, const SubCell& nodes, std::size_t side,
    const glm::dvec2& guess, const glm::dvec3& weight) const;
  bool StaysAlong(const CurvedPatch& patch, const SubCell& nodes, const ObjectLine& side, double& l,
    glm::dvec2& b) const;
  static bool IsSeen(const std::vector<MappedPoint>& points);
  bool FindEdgeOn(
    const Context& context, const SubCell& nodes, const Polygon& whole, EdgeOn& edgeOn) const;
  static bool MeetInside(const Polygon& whole, unsigned first, unsigned second);
  static bool EndEdgeOn(const EdgeOn& edgeOn, const Polygon& whole, Polygon& polygon);
  ImagePoint Finish(const Context& context, const PatchPoint& at, const glm::dvec3& point,
    const glm::dvec3& weight) const;

  const CurvedMembraneSolver& Geometry;
  double Tolerance;
  SubCellDivision Division;
  mutable KnownMeetings Known;
  mutable PiecePoints Shared;
};

}
