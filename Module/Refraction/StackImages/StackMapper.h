// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * All images of a triangle or a line through several interfaces: PrimitiveMapper for a stack.
 *
 * The cells of a SightSheet are intersected with the primitive's plane, leg by leg, and the result
 * is clipped by the primitive and by the two surfaces at the ends of the leg. The part on
 * leg 0, in front of all interfaces, passes unchanged. Corners are computed from the two
 * features that meet there alone, so that pieces meet bit by bit, on both sides of an interface as
 * well.
 */
#pragma once

#include "Refraction/Images/ObjectPrimitive.h"
#include "Refraction/StackImages/SightSheet.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

class StackMapper
{
public:
  StackMapper(const StackSolver& solver, const SightSheet& sheet)
    : Solver(solver)
    , Stack(solver.GetStack())
    , Sheet(sheet)
  {
  }

  using Corner = ClippedCorner<PrimitiveConstraints + 1>;
  using Polygon = std::vector<Corner>;

  /** Part of a primitive that a cell of the sheet shows, by linear interpolation of its rays. */
  struct Part
  {
    std::size_t Leg;
    std::int32_t Facet;
    LegCell Cell;
    Polygon Corners;
    double Sign; ///< of the rays' component along the primitive's normal
  };

  /** A triangle, or a line between the first two corners, in the coordinates of the stack. */
  ObjectPrimitive MakeTriangle(const MappedTriangle& triangle, std::int64_t sourceCell) const;
  ObjectPrimitive MakeLine(const MappedTriangle& line, std::int64_t sourceCell) const;

  /** Adds the parts of a primitive that are seen on any leg. */
  void Clip(const ObjectPrimitive& primitive, std::vector<Part>& parts) const;

  /**
   * True if a triangle can keep its corners: each has one image, the parts cover it once, on the
   * same leg and in one sense of rotation, and are drawn within `tolerance`, an angle in radians at
   * the eye, by the triangle of the corners' images.
   */
  bool IsWhole(
    const ObjectPrimitive& triangle, const std::vector<Part>& parts, double tolerance) const;

  /**
   * Adds the parts with exact corners: convex polygons with the winding of the triangle, or lines
   * of two points. Parts whose corners contradict each other are mapped from smaller cells. What
   * is still contradictory is left out; the solver counts it as undecided if it is wider than the
   * tolerance.
   */
  void Emit(
    const ObjectPrimitive& primitive, const std::vector<Part>& parts, ImageMesh& images) const;

private:
  enum class Finding
  {
    Found,
    EndWithoutImage, ///< an end of the primitive without an image in or next to the cell
    Elsewhere ///< a side that does not meet the surface there, or an end that is seen elsewhere
  };
  struct MappedPoint
  {
    ImagePoint Point;
    Finding Outcome;
  };
  /** The primitive, and the leg and the cell that it is mapped from. */
  struct Context
  {
    const ObjectPrimitive& Primitive;
    std::size_t Leg;
    std::int32_t Facet;
    const CurvedPatch& Patch; ///< in its own coordinates
    const LegCell& Cell;
  };

  void CollectFacets(
    const ObjectPrimitive& primitive, std::size_t leg, std::vector<std::int32_t>& facets) const;
  void ClipCell(const ObjectPrimitive& primitive, const Part& cell, std::vector<Part>& parts) const;
  double GetSlack(std::size_t surface, const glm::dvec3& place) const;
  bool ResolveTies(const ObjectPrimitive& primitive, const Part& cell, Polygon& whole) const;
  void EmitPart(
    const ObjectPrimitive& primitive, const Part& part, int depth, ImageMesh& images) const;
  bool DivideCell(const Part& part, std::array<LegCell, 4>& quarters) const;
  /** Twice the signed area of a polygon in the primitive's second and third coordinates. */
  static double GetArea(const Polygon& polygon);
  bool IsVisible(const Context& context, const Polygon& polygon) const;
  bool EmitPolygon(const Context& context, const Part& part, ImageMesh& images) const;
  int GetOrientation(const CurvedPatch& patch, const Part& part, double area) const;
  bool EmitLine(const Context& context, const Polygon& polygon, ImageMesh& images) const;
  MappedPoint MakePoint(const Context& context, const Corner& corner) const;
  MappedPoint MakeOnEdge(
    const Context& context, const ClippedBoundary& on, const glm::dvec2& place) const;
  MappedPoint MakeOnSide(const Context& context, std::size_t side, const glm::dvec2& b,
    const RefractedPoint& from, const StackPath* path) const;
  MappedPoint MakeEnd(const Context& context, glm::length_t end, const glm::dvec2& b) const;
  MappedPoint MakeOnSurface(
    const Context& context, const ClippedBoundary& on, const Corner& corner) const;
  MappedPoint MakeSideCrossing(const Context& context, std::size_t side, std::size_t surface,
    const glm::dvec2& b, glm::dvec3 weight) const;
  bool TraceSide(const Context& context, const SubCellSide& side, double s, std::size_t count,
    StackPath& path) const;
  bool TracePlace(
    const Context& context, const glm::dvec2& b, std::size_t count, StackPath& path) const;
  void TraceNear(const Context& context, const glm::dvec2& b, StackPath& path) const;
  ImagePoint Finish(const Context& context, const StackPath* path, const glm::dvec2& b,
    const glm::dvec3& local, const glm::dvec3& weight) const;
  bool ShootAgain(const StackTarget& target, StackPath& path) const;
  double GetSize(const Context& context) const;

  const StackSolver& Solver;
  const RefractionStack& Stack;
  const SightSheet& Sheet;
};

}
