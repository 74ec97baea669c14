// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Lines and triangles that the membrane shows once, divided where the virtual geometry bends.
 *
 * An edge is divided in the middle if the images of points on it are not where the virtual edge is
 * drawn, within a tolerance, and so are its halves. The points are its middle, the middles of its
 * halves and so on, until their sight points are as close as the membrane's vertices: between those
 * it has no waves. That depends on the edge alone, its two ends and their images, so neighbours
 * agree on every point and nothing is cracked. A triangle is divided by the middles of those of its
 * edges that are, until none is.
 */
#ifndef meniscus_Refraction_Images_EdgeSubdivision_h
#define meniscus_Refraction_Images_EdgeSubdivision_h

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ImageMesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** A point of the object and its one image. */
struct ImagedPoint
{
  std::int64_t Id;
  glm::dvec3 Point;
  const VirtualVertex* Image;
};

class EdgeSubdivision
{
public:
  /** `tolerance` is an angle in radians at the eye. */
  EdgeSubdivision(const CurvedMembraneSolver& geometry, double tolerance);

  /**
   * Whether the images of points on the edge are where the virtual edge is drawn. Images of
   * another branch are not.
   */
  bool IsStraight(const ImagedPoint& a, const ImagedPoint& b);

  /**
   * Adds the image of a triangle as triangles, wound as it is. False, and nothing is added, if a
   * point in between has no image.
   */
  bool AddTriangle(
    const std::array<ImagedPoint, 3>& corners, std::int64_t sourceCell, ImageMesh& images);

  /** Adds the image of a line as lines of two points, in the same way. */
  bool AddLine(
    const ImagedPoint& from, const ImagedPoint& to, std::int64_t sourceCell, ImageMesh& images);

  /**
   * Where neighbours draw the point at `l` from 0 to 1 of an edge, if `image` is on the branch
   * that they draw: its position is moved there, by no more than twice the tolerance.
   */
  void MoveOntoEdge(const ImagedPoint& a, const ImagedPoint& b, double l, VirtualVertex& image);

private:
  struct Node
  {
    glm::dvec3 Weight; ///< of the corners
    glm::dvec3 Point;
    VirtualVertex Vertex;
    std::int64_t Output = -1; ///< its place among the points of `images`, once it is there
  };
  /** A part of an edge. */
  struct Stretch
  {
    glm::dvec3 Point[2];
    glm::dvec3 Drawn[2]; ///< where the edge has them
    const VirtualVertex* Image[2];
  };
  struct Middle
  {
    glm::dvec3 Point{ std::numeric_limits<double>::quiet_NaN() };
    VirtualVertex Vertex;
  };
  /** An edge of nodes and the node in its middle, in a table that is searched from a hash on. */
  struct Edge
  {
    std::uint64_t Key;
    std::int32_t Middle;
    std::uint32_t Round; ///< the primitive that it belongs to
  };
  struct Cell
  {
    std::array<std::int64_t, 3> Ids;
    std::int64_t Source;
    signed char Orientation;
    ImageMesh* Images;
  };

  const VirtualVertex& FindMiddle(const glm::dvec3& a, const VirtualVertex& imageOfA,
    const glm::dvec3& b, const VirtualVertex& imageOfB);
  enum class Shape
  {
    Straight,
    Bent,
    Open ///< a point has no image
  };
  Shape FindShape(const glm::dvec3& a, const VirtualVertex& imageOfA, const glm::dvec3& b,
    const VirtualVertex& imageOfB);
  Shape FindShape(const Stretch& part, int depth);
  /** Within so many parts of the tolerance. */
  bool IsDrawnWell(const glm::dvec3& drawn, const VirtualVertex& image, double parts = 1.0) const;
  bool AreNeighbours(const VirtualVertex& a, const VirtualVertex& b) const;
  double GetSquaredSize(std::int32_t facet) const;
  void Start(const std::array<ImagedPoint, 3>& corners, std::size_t count);
  Edge& FindEdge(std::uint64_t key);
  void GrowEdges();
  std::int32_t Split(std::int32_t a, std::int32_t b, int depth);
  void Divide(const Cell& cell, const std::array<std::int32_t, 3>& nodes, int depth);
  void DivideLine(const Cell& cell, std::int32_t a, std::int32_t b, int depth);
  template <std::size_t N>
  void Emit(const Cell& cell, const std::array<std::int32_t, N>& nodes);

  const CurvedMembraneSolver& Geometry;
  double Tolerance;
  std::vector<Middle> Cache; ///< by the middle's coordinates, one each; forgets what is in the way
  std::vector<Node> Nodes;
  std::vector<Edge> Edges; ///< a power of two, at most half of them of this round
  std::size_t EdgeCount = 0;
  std::uint32_t Round = 0;
  bool Failed = false;
};

}

#endif
