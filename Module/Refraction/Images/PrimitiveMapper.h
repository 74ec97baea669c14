// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Every image of a triangle or a line, driven from the membrane.
 *
 * A patch that may show the primitive is divided into triangles, sub-cells, so fine that its rays
 * are nearly linear in each. The rays at the corners of a sub-cell meet the primitive's plane; what
 * they cut out of it is clipped by the primitive, and every corner of the clipped polygon is an
 * image. So caustics, borders of the membrane and places where the primitive crosses it need no
 * case of their own: an image is there exactly where a sub-cell looks at the primitive.
 *
 * Pieces meet bit by bit. A side of a sub-cell is divided for reasons that lie in the side alone.
 * Where it passes a side of the primitive, a node looks at the primitive's plane, or an end of the
 * primitive is seen, the corner is computed from the two that meet there alone (CurveCrossings),
 * and a corner that the exact place would put beyond an end of the primitive is that end's image.
 * Which sub-cell holds an end is told by linear interpolation, which two triangles with the end in
 * common may see differently: SeamClosure closes what that leaves open along their common side.
 */
#ifndef meniscus_Refraction_Images_PrimitiveMapper_h
#define meniscus_Refraction_Images_PrimitiveMapper_h

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ImageMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** The images of a point of the object, borrowed. */
struct KnownImages
{
  const ImagePoint* First = nullptr;
  std::size_t Count = 0;
};

/** Corners of a primitive in world coordinates, their indices in the object and their images. */
struct MappedTriangle
{
  std::array<std::int64_t, 3> Ids;
  std::array<glm::dvec3, 3> Corners;
  std::array<KnownImages, 3> Images{};
};

/** A point of a triangle in barycentric and in world coordinates. */
struct TrianglePoint
{
  glm::dvec3 Weight;
  glm::dvec3 Position;
};

/**
 * A straight piece of the curve along which a triangle meets the membrane. The part behind the
 * membrane is on its left, as the triangle is wound.
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
   * `tolerance` is the angle, in radians at the eye, that linear interpolation in a sub-cell may
   * be off at the distances `nearest` and `farthest` behind the membrane.
   */
  PrimitiveMapper(
    const CurvedMembraneSolver& geometry, double tolerance, double nearest, double farthest);

  /**
   * Adds the images of a triangle as convex polygons, wound as the triangle is. If it may cross
   * the membrane, the part in front of it is added as it is.
   */
  void MapTriangle(const MappedTriangle& triangle, std::int64_t sourceCell, bool mayCross,
    ImageMesh& images) const;

  /** Adds the images of a line between the first two corners as lines of two points. */
  void MapLine(
    const MappedTriangle& line, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const;

private:
  struct Node;
  struct Corner;
  struct Context;
  struct Boundary;
  using Polygon = std::vector<Corner>;
  enum class Finding
  {
    Found,
    EndWithoutImage, ///< an end of the primitive that has no image in or next to the sub-cell
    Elsewhere ///< a side that does not meet the membrane there, or an end that is seen elsewhere
  };
  struct MappedPoint
  {
    ImagePoint Point;
    Finding Outcome;
  };

  void MapSides(Context& context, const glm::dvec3& middle, double padding, bool mayCross,
    ImageMesh& images) const;
  void Map(const Context& context, const glm::dvec3& middle, double padding) const;
  std::vector<WaterlinePiece> DropInFront(
    const Context& context, const ImageMesh& from, ImageMesh& images) const;
  Node MakeNode(const CurvedPatch& patch, const glm::dvec2& b) const;
  bool IsSplit(const Node& a, const Node& middle, const Node& b) const;
  void Divide(const Context& context, const std::array<Node, 3>& nodes, int depth) const;
  void MapSubCell(const Context& context, const std::array<Node, 3>& nodes) const;
  void Emit(const Context& context, const std::array<Node, 3>& nodes, const Polygon& polygon,
    double sign) const;
  void EmitLine(
    const Context& context, const std::array<Node, 3>& nodes, const Polygon& polygon) const;
  MappedPoint MakePoint(
    const Context& context, const std::array<Node, 3>& nodes, const Corner& corner) const;
  MappedPoint MakeEnd(const Context& context, const std::array<Node, 3>& nodes, glm::length_t end,
    const glm::dvec2& interpolated) const;
  static double GetSize(const std::array<Node, 3>& nodes);
  static glm::dvec2 GuessSight(const std::array<Node, 3>& nodes, const glm::dvec3& point);
  MappedPoint MakeOnSide(const Context& context, const std::array<Node, 3>& nodes, std::size_t side,
    const RefractedPoint& from, const glm::dvec2& interpolated) const;
  MappedPoint MakeCrossing(const Context& context, const std::array<Node, 3>& nodes,
    const Corner& corner, const Boundary& on) const;
  MappedPoint MakeSideCrossing(const Context& context, const std::array<Node, 3>& nodes,
    std::size_t side, const glm::dvec2& guess, const glm::dvec3& weight) const;
  static bool IsSeen(const std::vector<MappedPoint>& points);
  ImagePoint Finish(const Context& context, const PatchPoint& at, const glm::dvec3& point,
    const glm::dvec3& weight) const;

  const CurvedMembraneSolver& Geometry;
  double Tolerance;
  double Distance[2];
};

}

#endif
