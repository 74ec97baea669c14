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
 * Nothing is cracked: an edge of a sub-cell is divided for reasons that lie in the edge alone, and
 * where it meets an edge of the primitive the place is solved for on both, whatever the plane.
 */
#ifndef meniscus_Refraction_MembraneMapping_h
#define meniscus_Refraction_MembraneMapping_h

#include "Refraction/CurvedGeometry.h"
#include "Refraction/ImageMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/// Corners of a primitive in world coordinates, and their indices in the object.
struct MappedTriangle
{
  std::array<std::int64_t, 3> ids;
  std::array<glm::dvec3, 3> corners;
};

class MembraneMapping
{
public:
  /// `tolerance` is the angle, in radians at the eye, that linear interpolation in a sub-cell may
  /// be off at the distances `nearest` and `farthest` behind the membrane.
  MembraneMapping(
    const CurvedGeometry& geometry, double tolerance, double nearest, double farthest);

  /// Adds the images of a triangle as convex polygons, wound as the triangle is. If it may cross
  /// the membrane, the part in front of it is added as it is.
  void MapTriangle(const MappedTriangle& triangle, std::int64_t sourceCell, bool mayCross,
    ImageMesh& images) const;

  /// Adds the images of a line between the first two corners as lines of two points.
  void MapLine(
    const MappedTriangle& line, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const;

private:
  struct Node;
  struct Plane;
  struct Corner;
  struct Context;
  struct Boundary;
  using Polygon = std::vector<Corner>;

  void MapSides(Context& context, const glm::dvec3& middle, double padding, bool mayCross,
    ImageMesh& images) const;
  void Map(const Context& context, const glm::dvec3& middle, double padding) const;
  void DropInFront(const Context& context, const ImageMesh& from, ImageMesh& images) const;
  void FindSight(const Context& context, const glm::dvec3& weight, glm::dvec2& b) const;
  ImagePoint Finish(const Context& context, const glm::dvec2& b, const glm::dvec3& weight) const;
  Node MakeNode(const CurvedPatch& patch, const glm::dvec2& b) const;
  bool IsSplit(const Node& a, const Node& middle, const Node& b) const;
  void Divide(const Context& context, const std::array<Node, 3>& nodes, int depth) const;
  void MapSubCell(const Context& context, const std::array<Node, 3>& nodes) const;
  void Emit(const Context& context, const std::array<Node, 3>& nodes, const Polygon& polygon,
    double sign) const;
  void EmitLine(
    const Context& context, const std::array<Node, 3>& nodes, const Polygon& polygon) const;
  ImagePoint MakePoint(
    const Context& context, const std::array<Node, 3>& nodes, const Corner& corner) const;

  const CurvedGeometry& Geometry;
  double Tolerance;
  double Distance[2];
};

}

#endif
