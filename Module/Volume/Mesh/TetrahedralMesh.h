// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Tables of a tetrahedral mesh for ray casting: renumbered vertices and cells, neighbours across
 * faces, and the oriented boundary. Built once per mesh, independent of scalars and camera.
 *
 * Method:
 * 1. Cells with an index out of range, a repeated vertex or a vertex that is not finite are
 *    rejected and counted, and so is each cell that has the same four vertices as one before it in
 *    the input. Zero-volume and inverted cells are kept: the mesh needs them to be conforming.
 * 2. Vertices and cells are renumbered along a Morton curve, so that neighbours on a ray are
 *    neighbours in memory; vertices by the cells that use them, if they outnumber the cells. The
 * vertices of a cell are stored in ascending order; the local index of a vertex is its rank, which
 * gives every tie in the walk one answer in all cells.
 * 3. Cells are linked across faces that exactly two cells share. A face of three or more cells is
 *    boundary on all sides, and rays cross it as a gap of length zero.
 * 4. Orientation is combinatorial: a flood fill over linked faces, not the sign of each volume. A
 *    link that contradicts the flood fill (a non-orientable ring of cells) is cut. The sign of a
 *    component is that of the sum of its volumes; one whose volumes cancel, a region filled twice
 *    with different cells of the same points, is taken apart into cells on opposite sides of faces.
 *
 * Cells that cannot be seen can be made inactive: links to them read as negative, like the
 * boundary, and GetBoundary() is that of the active cells. So rays enter, and leave, where the
 * active cells do.
 */
#ifndef meniscus_Volume_Mesh_TetrahedralMesh_h
#define meniscus_Volume_Mesh_TetrahedralMesh_h

#include "Common/RangeLoop.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/** A mesh as plain arrays, which stay the caller's. */
struct TetrahedraView
{
  /** xyz triples, NumberOfPoints of them; null if FloatPoints are given. */
  const double* Points = nullptr;
  std::int64_t NumberOfPoints = 0;
  /** Point indices, four per cell, in either orientation; null if ShortCells are given. */
  const std::int64_t* Cells = nullptr;
  std::int64_t NumberOfCells = 0;
  const float* FloatPoints = nullptr;
  const std::int32_t* ShortCells = nullptr;
  /** Per cell; one with a bit of LeftOutBits is left out, uncounted. Null for none. */
  const std::uint8_t* CellFlags = nullptr;
  std::uint8_t LeftOutBits = 0xFF;
  /** Whether GetSourceCells() is wanted: 4 bytes per cell. */
  bool KeepSourceCells = false;
  /** Per cell, what GetSourceCells() says of it; null for its own number. */
  const std::int32_t* SourceCells = nullptr;
  /** Whether points at the same position make cells duplicates of each other: several data sets. */
  bool MatchPositions = false;
};

/** How a mesh is built. */
struct MeshBuildControl
{
  RangeLoop Loop = SerialLoop;
  /** Told the fraction done, on the calling thread; false aborts. */
  std::function<bool(double)> Progress;
};

enum class MeshStatus
{
  Ok,
  /** No cell is left after validation; the tables are empty. */
  Empty,
  /** More cells or points than 32-bit tables can index. */
  TooLarge,
  /** Given up on the caller's wish; the tables are empty. */
  Aborted
};

/** Cells left out, by reason; a cell is counted once, for the first reason that holds. */
struct RejectedCells
{
  std::int64_t IndexOutOfRange = 0;
  std::int64_t RepeatedVertex = 0;
  std::int64_t PointNotFinite = 0;
  /** Cells that have the same vertices as one before them, which is kept. */
  std::int64_t Duplicate = 0;

  std::int64_t Total() const
  {
    return IndexOutOfRange + RepeatedVertex + PointNotFinite + Duplicate;
  }
};

class VisibleScalars;

/** Bytes that a table takes. */
template <typename T>
std::int64_t BytesOf(const std::vector<T>& table)
{
  return static_cast<std::int64_t>(table.capacity() * sizeof(T));
}

/** A face of an active cell without an active cell on the other side. */
struct BoundaryFace
{
  /** Mesh vertices in ascending order. */
  std::array<std::int32_t, 3> Vertices;
  /** +1 if the triangle, in that order, has its normal (right-hand rule) out of the mesh, else -1.
   */
  std::int32_t Outward;
  /** Cell * 4 + index of the cell's vertex opposite to the face. */
  std::int32_t CellFace;
};

class TetrahedralMesh
{
public:
  /** Largest number of cells: a link stores 4 * cell + face and its mark in 32 bits. */
  static constexpr std::int64_t MaximumNumberOfCells = (std::int64_t{ 1 } << 29) - 1;
  /** Positions are rounded once, to fixed point of this unit: within 2^-31 of the radius. */
  static constexpr double PositionUnit = 1.0 / (std::int64_t{ 1 } << 30);
  /** The link of a face without a neighbour. */
  static constexpr std::int32_t NoNeighbor = -1;

  /** Builds all tables; earlier contents are replaced. They do not depend on the loop. */
  MeshStatus Build(
    const TetrahedraView& input, const MeshBuildControl& control = MeshBuildControl());

  std::int64_t GetNumberOfCells() const { return static_cast<std::int64_t>(this->Cells.size()); }
  std::int64_t GetNumberOfVertices() const
  {
    return static_cast<std::int64_t>(this->Positions.size());
  }

  struct Cell
  {
    /** Mesh vertices in ascending order. */
    std::array<std::int32_t, 4> Vertices;
    /**
     * Across the face opposite to vertex i: 4 * cell + face of the neighbour, or NoNeighbor. If the
     * neighbour is inactive, MarkedLink() of that, which is less than NoNeighbor.
     */
    std::array<std::int32_t, 4> Links;
  };

  /** Marks a link as leading to an inactive neighbour, and takes the mark away again. */
  static constexpr std::int32_t MarkedLink(std::int32_t link) { return NoNeighbor - 1 - link; }

  /**
   * Makes those cells active whose scalars can be seen; all cells are after Build(). One with a
   * vertex that has no scalar (NaN) is inactive. Returns whether a cell changed.
   * @param scalars  one normalised scalar per vertex.
   */
  bool UpdateActiveCells(const std::vector<float>& scalars, const VisibleScalars& visible,
    const RangeLoop& loop = SerialLoop);

  enum class CellJumps
  {
    /** Only the values of the cells can be seen. */
    Hidden,
    /** So can all between the values of two cells, on the face that they share (isosurfaces). */
    Visible
  };
  /** The same for a mesh whose cells have one value each, NaN for none. */
  bool UpdateActiveCells(const std::vector<float>& cellScalars, CellJumps jumps,
    const VisibleScalars& visible, const RangeLoop& loop = SerialLoop);

  /**
   * Makes those cells active that are marked by 1, the others by 0. Returns whether one changed.
   * @param unknown  cells without a scalar.
   */
  bool SetActiveCells(const std::vector<std::uint8_t>& active, std::int64_t unknown,
    const RangeLoop& loop = SerialLoop);

  std::int64_t GetNumberOfActiveCells() const { return this->ActiveCells; }
  /** Cells without a scalar in the last update of the active cells. */
  std::int64_t GetNumberOfUnknownCells() const { return this->UnknownCells; }

  const std::vector<Cell>& GetCells() const { return this->Cells; }
  /** Vertex positions relative to GetCenter(), in units of GetRadius() * PositionUnit. */
  const std::vector<glm::ivec3>& GetFixedPositions() const { return this->Positions; }
  /** Vertex position relative to GetCenter(), in units of GetRadius(). */
  glm::dvec3 GetPosition(std::int64_t vertex) const
  {
    return PositionUnit * glm::dvec3(this->Positions[vertex]);
  }
  /** Input point of each vertex. */
  const std::vector<std::int32_t>& GetSourcePoints() const { return this->SourcePoints; }
  /** Input cell of each cell, if wanted; else empty. */
  const std::vector<std::int32_t>& GetSourceCells() const { return this->SourceCells; }
  const std::vector<BoundaryFace>& GetBoundary() const { return this->Boundary; }
  /** A face of an active cell as the boundary has it: see BoundaryFace. */
  BoundaryFace GetFace(std::int64_t cell, int face) const;
  const RejectedCells& GetRejectedCells() const { return this->Rejected; }
  /** Links cut because they contradict the flood fill, or in components whose volumes cancel. */
  std::int64_t GetNumberOfCutLinks() const { return this->CutLinks; }
  /** Bytes of all tables. */
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Cells) + BytesOf(this->Positions) + BytesOf(this->SourcePoints) +
      BytesOf(this->SourceCells) + BytesOf(this->Boundary) + BytesOf(this->Orientation);
  }
  /** Centre of the bounding box of the used points. */
  const glm::dvec3& GetCenter() const { return this->Center; }
  /** Largest distance of a vertex from the centre; 0 if all vertices coincide or there are none. */
  double GetRadius() const { return this->Radius; }

private:
  class Builder;

  void Clear();
  void ForgetAllButTables();
  void LinkCells(const RangeLoop& loop);
  void OrientCells(const RangeLoop& loop);
  struct ScalarRange;
  template <typename RangeOf>
  bool ActivateCells(RangeOf&& rangeOf, const VisibleScalars& visible, const RangeLoop& loop);
  void MarkLinks(const std::vector<std::uint8_t>& active, const RangeLoop& loop);
  void CollectBoundary(const RangeLoop& loop);

  std::vector<Cell> Cells;
  std::vector<glm::ivec3> Positions;
  std::vector<std::int32_t> SourcePoints;
  std::vector<std::int32_t> SourceCells;
  std::vector<BoundaryFace> Boundary;
  /**
   * Per cell, positive if its ascending vertices form a positively oriented tetrahedron, else
   * negative. 1 if the cell is active, 2 if not.
   */
  std::vector<std::int8_t> Orientation;
  RejectedCells Rejected;
  std::int64_t CutLinks = 0;
  std::int64_t ActiveCells = 0;
  std::int64_t UnknownCells = 0;
  glm::dvec3 Center{ 0.0 };
  double Radius = 0.0;
};

}

#endif
