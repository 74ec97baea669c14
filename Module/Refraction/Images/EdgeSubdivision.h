// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Subdivision of lines and triangles that the membrane shows once, where their virtual geometry is
 * curved.
 *
 * An edge is divided in the middle unless the images of points on it lie on the virtual edge within
 * a tolerance; its halves are then treated in the same way. The tested points are its middle, the
 * middles of its halves and so on, until the sight points of neighbours among these points and the
 * ends are as close as the membrane's vertices, between which the membrane has no waves. Halves
 * whose ends are that close are not tested if they are expected to be off by less than the
 * tolerance: a curve leaves its chord by the square of the chord's length. The result depends on
 * the edge alone, on its two ends and their images, so neighbours agree on every point and no
 * cracks appear.
 * A triangle is divided at the middles of its divided edges until none of its edges needs division,
 * or until it has MostNodes: its parts are then as they are, with larger errors, and there may be
 * cracks of that size next to its neighbours.
 */
#pragma once

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ImageMesh.h"

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

namespace meniscus
{

/** A point of the object that has a single image, and that image. */
struct ImagedPoint
{
  std::int64_t Id;
  glm::dvec3 Point;
  const VirtualVertex* Image;
};

class EdgeSubdivision
{
public:
  /** Points of one triangle, which take 10 MB. */
  static constexpr std::size_t MostNodes = 65536;

  /**
   * An edge that was off by at most this many tolerances has halves that are off by a quarter of
   * that, if its bend is the same everywhere. The rest of the tolerance is for bends that change:
   * below waves of four facets, the shortest ones, halves are off by 1.1 tolerances at most.
   */
  static constexpr double TestedParts = 1.5;

  /**
   * The same for an edge whose error is that of the edge twice as long, along it or parallel to it,
   * divided by four, up to this part of it: the bend has been seen to change little. Its halves are
   * off by (1 + MostChange / 2) / 4 of that, 0.7 tolerances, if the change goes on as it is.
   */
  static constexpr double FollowedParts = 2.5;
  static constexpr double MostChange = 0.25;

  /** `tolerance` is an angle in radians at the eye. */
  EdgeSubdivision(const CurvedMembraneSolver& geometry, double tolerance);
  ~EdgeSubdivision();
  EdgeSubdivision(const EdgeSubdivision&) = delete;
  EdgeSubdivision& operator=(const EdgeSubdivision&) = delete;

  /**
   * For each of some edges: true if the images of points on it lie on the virtual edge within the
   * tolerance. An image of another branch does not.
   */
  std::vector<bool> AreStraight(const std::vector<std::array<ImagedPoint, 2>>& edges);

  /**
   * Adds the image of a triangle as triangles with the same winding. Returns false, and adds
   * nothing, if a point in between has no image.
   */
  bool AddTriangle(
    const std::array<ImagedPoint, 3>& corners, std::int64_t sourceCell, ImageMesh& images);

  /** Adds the image of a line as lines of two points, in the same way. */
  bool AddLine(
    const ImagedPoint& from, const ImagedPoint& to, std::int64_t sourceCell, ImageMesh& images);

  /**
   * Moves the position of `image` onto the virtual edge that the neighbours draw, at the parameter
   * `l` from 0 to 1, if `image` is on the branch that they draw. The shift is at most twice the
   * tolerance.
   */
  void MoveOntoEdge(const ImagedPoint& a, const ImagedPoint& b, double l, VirtualVertex& image);

  /** Number of triangles whose division has ended at MostNodes. */
  std::int64_t GetNumberOfCoarse() const { return this->Coarse; }

private:
  struct Node
  {
    glm::dvec3 Weight; ///< barycentric weights with respect to the corners
    glm::dvec3 Point;
    VirtualVertex Vertex;
    std::int64_t Output = -1; ///< index among the points of `images`; -1 until it is added
  };
  enum class Shape
  {
    Straight,
    Bent,
    Open,     ///< a point has no image
    Undecided ///< the halves have to be tested
  };
  /** An edge that is tested, and the result. */
  struct Side
  {
    Shape Form = Shape::Straight;
    VirtualVertex Middle;
    glm::dvec3 Error{ 0.0 }; ///< of the drawn middle
  };
  /** A part of an edge between two tested points. */
  struct Stretch
  {
    std::size_t Side; ///< index of the edge
    glm::dvec3 Point[2];
    glm::dvec3 Drawn[2]; ///< positions of the ends on the virtual edge as it is drawn
    const VirtualVertex* Image[2];

    glm::dvec3 GetMiddle() const { return 0.5 * (this->Point[0] + this->Point[1]); }
  };
  struct Middle
  {
    std::uint64_t Owner = 0; ///< number of the object that has stored the middle
    std::uint64_t Batch = 0; ///< points that are solved together: the last ones it belonged to
    glm::dvec3 Point;
    VirtualVertex Vertex;
  };
  bool IsStored(const Middle& middle, const glm::dvec3& point) const
  {
    return middle.Owner == this->Number && middle.Point == point;
  }
  static std::vector<Middle>& GetSpareCache();
  /**
   * An edge between two nodes and the node in its middle: an entry of a hash table with linear
   * probing.
   */
  struct Edge
  {
    std::uint64_t Key;
    std::int32_t Middle;
    std::uint32_t Round; ///< number of the primitive that the entry belongs to
    /** True if edges of half the length, along this one or parallel to it, need no test. */
    bool IsSmooth = false;
    bool Follows = false;    ///< the bend is as that of the edge twice as long
    glm::dvec3 Error{ 0.0 }; ///< of the drawn middle; expected if the edge is not tested
  };
  /** Nodes of a part of a triangle, and the edges opposite to them. */
  using NodeIds = std::array<std::int32_t, 3>;
  using EdgesOfPart = std::array<Edge, 3>;
  struct Cell
  {
    std::array<std::int64_t, 3> Ids;
    std::int64_t Source;
    signed char Orientation;
    ImageMesh* Images;
  };

  Middle& FindEntry(const glm::dvec3& point);
  const VirtualVertex& FindMiddle(const Stretch& part);
  void SearchIfLost(const glm::dvec3& point, VirtualVertex& image);
  void PrepareMiddles();
  void AddTested(const ImagedPoint& from, const ImagedPoint& to);
  void JudgeSides();
  static std::array<Stretch, 2> Halve(const Stretch& part, const VirtualVertex& middle);
  Shape JudgeMiddle(
    const Stretch& part, const VirtualVertex& middle, const glm::dvec3& error, int depth) const;
  glm::dvec3 GetError(const glm::dvec3& drawn, const VirtualVertex& image) const;
  bool AreNeighbours(const VirtualVertex& a, const VirtualVertex& b) const;
  bool MayTurn(const VirtualVertex& a, const VirtualVertex& b) const;
  static bool Follows(const Side& side, const glm::dvec3& expected);
  bool AreHalvesSmooth(
    const VirtualVertex& a, const Side& side, const VirtualVertex& b, bool follows) const;
  bool AreSampled(const VirtualVertex& a, const VirtualVertex& b) const;
  bool AreSampled(std::int32_t a, std::int32_t b) const
  {
    return this->AreSampled(this->Nodes[static_cast<std::size_t>(a)].Vertex,
      this->Nodes[static_cast<std::size_t>(b)].Vertex);
  }
  bool HasEdge(std::int32_t facet, double squaredLength) const;
  void Start(const std::array<ImagedPoint, 3>& corners, std::size_t count);
  static std::uint64_t MakeKey(std::int32_t a, std::int32_t b);
  Edge& FindEdge(std::uint64_t key);
  Edge& AddUntested(std::int32_t a, std::int32_t b, const glm::dvec3& error, bool isStraight);
  void GrowEdges();
  Edge GetEdge(std::int32_t a, std::int32_t b);
  void TestEdge(std::int32_t a, std::int32_t b);
  void SettleEdges();
  void SettleEdge(std::uint64_t key, const Side& side);
  void SettleLevel(std::size_t begin, std::size_t end);
  void Divide(const Cell& cell);
  void AddParallels(const EdgesOfPart& edges);
  static glm::dvec3 ExpectMedian(const EdgesOfPart& edges, std::size_t k);
  void AddMedian(const NodeIds& nodes, const EdgesOfPart& edges, std::size_t k);
  void DividePart(const Cell& cell, const NodeIds& nodes);
  void DivideLine(const Cell& cell, std::int32_t a, std::int32_t b, int depth);
  template <std::size_t N>
  void Emit(const Cell& cell, const std::array<std::int32_t, N>& nodes);

  const CurvedMembraneSolver& Geometry;
  double Tolerance;
  glm::dvec3 Eye;          ///< in world coordinates
  std::uint64_t Number;    ///< of this object; no other one has it
  std::uint64_t Batch = 0; ///< number of the points that are solved together next
  /**
   * Indexed by a hash of the middle's coordinates, one entry each; a new entry replaces the old
   * one. The next object of the same thread takes over the memory.
   */
  std::vector<Middle> Cache;
  std::vector<Node> Nodes;
  /** Parts of a triangle that are to be divided, and their parts. */
  std::vector<NodeIds> Level;
  std::vector<NodeIds> NextLevel;
  /**
   * Edges that are tested and their keys; their parts that are tested next, those after them, and
   * images of their ends.
   */
  std::vector<Side> Sides;
  std::vector<std::uint64_t> TestedKeys;
  std::vector<Stretch> Tested;
  std::vector<Stretch> NextTested;
  std::deque<VirtualVertex> TestedImages;
  std::vector<VirtualVertex> Searched; ///< kept so that its memory is reused
  std::vector<Edge> Edges; ///< the size is a power of two; at most half of the entries belong to
                           ///< this round
  std::size_t EdgeCount = 0;
  std::uint32_t Round = 0;
  bool Failed = false;
  bool IsFull = false; ///< an edge was not divided because of MostNodes
  std::int64_t Coarse = 0;
};

}
