// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Tables of a tetrahedral mesh for ray casting: renumbered vertices and cells, neighbours across
 * faces, and the oriented boundary. Built once per mesh, independent of scalars and camera.
 *
 * Method:
 * 1. Cells with an index out of range, a repeated vertex or a vertex that is not finite are
 *    rejected and counted, and so is each cell with the same four vertices as an earlier cell of
 *    the input. Zero-volume and inverted cells are kept: the mesh needs them to be conforming.
 * 2. Vertices and cells are renumbered along a Morton curve, so that neighbours on a ray are
 *    neighbours in memory; vertices by the cells that use them, if they outnumber the cells. The
 *    vertices of a cell are stored in ascending order; the local index of a vertex is its rank,
 *    which gives every tie in the walk the same answer in all cells.
 * 3. Cells are linked across faces that exactly two cells share. A face of three or more cells is
 *    part of the boundary on all sides, and rays cross it as a gap of length zero.
 * 4. Orientation is combinatorial: a flood fill over linked faces, not the sign of each volume. A
 *    link that contradicts the flood fill (a non-orientable ring of cells) is cut. The sign of a
 *    component is the sign of the sum of its volumes. A component whose volumes cancel, a region
 *    filled twice with different cells of the same points, is taken apart into cells on opposite
 *    sides of faces.
 *
 * Points can move: MovePoints() places the vertices anew and keeps their order, the cells and the
 * links. These do not depend on positions, except in the cases that it reports.
 *
 * Cells that cannot be seen can be made inactive: links to them read as negative, like the
 * boundary. GetBoundary() is the boundary of the active cells, where rays enter and leave the mesh.
 */
#pragma once

#include "Common/BitTable.h"
#include "Common/RangeLoop.h"
#include "Volume/Mesh/PointsView.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace meniscus
{

/** A mesh as plain arrays, owned by the caller. */
struct TetrahedraView
{
  PointsView Points;
  std::int64_t NumberOfPoints = 0;
  /** Point indices, four per cell, in either orientation; null if ShortCells are given. */
  const std::int64_t* Cells = nullptr;
  std::int64_t NumberOfCells = 0;
  /** The same as Cells in 32 bits. */
  const std::int32_t* ShortCells = nullptr;
  /**
   * One entry per cell; a cell with any of LeftOutBits set is skipped without being counted. Null
   * if all cells are used.
   */
  const std::uint8_t* CellFlags = nullptr;
  std::uint8_t LeftOutBits = 0xFF;
  /** True if GetSourceCells() is wanted, which takes 4 bytes per cell. */
  bool KeepSourceCells = false;
  /** Cell of the caller's data that each cell is a part of; null if it is the cell itself. */
  const std::int32_t* SourceCells = nullptr;
  /** True if equal positions make cells duplicates of each other: needed for several data sets. */
  bool MatchPositions = false;
};

/** Options for building a mesh. */
struct MeshBuildControl
{
  RangeLoop Loop = SerialLoop;
  /** Called on the calling thread with the fraction done; returns false to abort. */
  std::function<bool(double)> Progress;
};

enum class MeshStatus
{
  Ok,
  /** Validation has left no cell; the tables are empty. */
  Empty,
  /** More cells or points than 32-bit tables can index. */
  TooLarge,
  /** The caller has aborted; the tables are empty. */
  Aborted
};

/** Cells left out, by reason. A cell is counted once, under the first reason that applies. */
struct RejectedCells
{
  std::int64_t IndexOutOfRange = 0;
  std::int64_t RepeatedVertex = 0;
  std::int64_t PointNotFinite = 0;
  /** Cells with the same vertices as an earlier cell, which is kept. */
  std::int64_t Duplicate = 0;

  std::int64_t Total() const
  {
    return IndexOutOfRange + RepeatedVertex + PointNotFinite + Duplicate;
  }
};

struct CellMeasures;
struct ComponentVolume;
class VisibleScalars;

/** Size of a table in bytes. */
template <typename T>
std::int64_t BytesOf(const std::vector<T>& table)
{
  return static_cast<std::int64_t>(table.capacity() * sizeof(T));
}

/** A face of an active cell without an active cell on its other side. */
struct BoundaryFace
{
  /**
   * Mesh vertices, in an order in which the normal of the triangle, by the right-hand rule, points
   * out of the mesh: ascending, or ascending with the first two exchanged.
   */
  std::array<std::int32_t, 3> Vertices;
  /** Cell * 4 + index of the cell's vertex opposite the face. */
  std::int32_t CellFace;

  bool IsAscending() const { return this->Vertices[0] < this->Vertices[1]; }
};

class TetrahedralMesh
{
public:
  /** Largest number of cells: a link stores 4 * cell + face and its mark in 32 bits. */
  static constexpr std::int64_t MaximumNumberOfCells = (std::int64_t{ 1 } << 29) - 1;
  /** Unit of fixed-point positions. Positions are rounded once, to within 2^-31 of the radius. */
  static constexpr double PositionUnit = 1.0 / (std::int64_t{ 1 } << 30);
  /**
   * Least length of an edge, in units of the radius, that rays measure to 1/128. Depths along a ray
   * are rounded to 24 bits relative to a place in the mesh, by up to 2^-25 of the radius each. The
   * difference of two is off by up to 2^-24, which is 1/128 of this length.
   */
  static constexpr double ShortestPreciseEdge = 1.0 / (1 << 17);
  /** Link of a face without a neighbour. */
  static constexpr std::int32_t NoNeighbor = -1;

  /** Builds all tables and replaces earlier contents. The result does not depend on the loop. */
  MeshStatus Build(
    const TetrahedraView& input, const MeshBuildControl& control = MeshBuildControl());

  /**
   * Moves the points of the mesh; cells and active cells stay. The tables are equal to the result
   * of Build() for the moved points, except for the order of vertices and cells, which also decides
   * where a ring without orientation is cut. This order remains the order of the points given to
   * Build() along the curve; neighbours are still neighbours in memory.
   *
   * Returns false if Build() must be called instead, because more than the positions would change:
   * - a position is or was not finite: cells are left out;
   * - positions decide on duplicates (TetrahedraView::MatchPositions), and other points coincide;
   * - volumes of connected cells cancel or did so: links are cut;
   * - all points coincided: the order of the vertices is arbitrary.
   * The tables must not be used then.
   * @param points as many as those given to Build().
   */
  bool MovePoints(const PointsView& points, const RangeLoop& loop = SerialLoop);

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
     * Link across the face opposite vertex i: 4 * cell + face of the neighbour, or NoNeighbor. If
     * the neighbour is inactive, it is MarkedLink() of that value, which is less than NoNeighbor.
     */
    std::array<std::int32_t, 4> Links;
  };

  /** Marks a link to an inactive neighbour, or removes the mark. */
  static constexpr std::int32_t MarkedLink(std::int32_t link) { return NoNeighbor - 1 - link; }

  /**
   * Activates the cells whose scalars can be seen and deactivates all others; after Build() all
   * cells are active. A cell with a vertex without a scalar (NaN) is inactive. Returns true if a
   * cell changed.
   * @param scalars one normalised scalar per vertex.
   */
  bool UpdateActiveCells(const std::vector<float>& scalars, const VisibleScalars& visible,
    const RangeLoop& loop = SerialLoop);

  enum class CellJumps
  {
    /** Only the values of the cells can be seen. */
    Hidden,
    /**
     * All scalars between the values of two cells can also be seen, on their common face
     * (isosurfaces).
     */
    Visible
  };
  /** As above, for a mesh with one value per cell, NaN for none. */
  bool UpdateActiveCells(const std::vector<float>& cellScalars, CellJumps jumps,
    const VisibleScalars& visible, const RangeLoop& loop = SerialLoop);

  /**
   * Activates the cells that are marked by 1 and deactivates those marked by 0. Returns true if a
   * cell changed.
   * @param unknown number of cells without a scalar.
   */
  bool SetActiveCells(const std::vector<std::uint8_t>& active, std::int64_t unknown,
    const RangeLoop& loop = SerialLoop);

  /** True if rays visit the cell. */
  const BitTable& GetActiveCells() const { return this->IsActive; }
  bool IsActiveCell(std::int64_t cell) const
  {
    return this->IsActive[static_cast<std::size_t>(cell)];
  }
  std::int64_t GetNumberOfActiveCells() const { return this->ActiveCells; }
  /** Number of cells without a scalar in the last update of the active cells. */
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
  /** Input cell of each cell if requested; otherwise empty. */
  const std::vector<std::int32_t>& GetSourceCells() const { return this->SourceCells; }
  const std::vector<BoundaryFace>& GetBoundary() const { return this->Boundary; }
  /** True if the cell's ascending vertices form a positively oriented tetrahedron. */
  bool IsPositivelyOriented(std::int64_t cell) const
  {
    return this->IsPositive[static_cast<std::size_t>(cell)];
  }
  /** A face of a cell in the form of the boundary: see BoundaryFace. */
  BoundaryFace GetFace(std::int64_t cell, int face) const;
  /** Puts the vertices of a face, which may be those before a motion, into that order. */
  void Orient(BoundaryFace& face) const;
  const RejectedCells& GetRejectedCells() const { return this->Rejected; }
  /**
   * Number of links cut because they contradict the flood fill, or in components whose volumes
   * cancel.
   */
  std::int64_t GetNumberOfCutLinks() const { return this->CutLinks; }
  /** Size of all tables in bytes. */
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Cells) + BytesOf(this->Positions) + BytesOf(this->SourcePoints) +
      BytesOf(this->SourceCells) + BytesOf(this->Boundary) + this->IsPositive.GetBytes() +
      this->IsActive.GetBytes() + BytesOf(this->Components) + BytesOf(this->Coincident);
  }
  /** Centre of the bounding box of the used points. */
  const glm::dvec3& GetCenter() const { return this->Center; }
  /** Half edges of the bounding box of the used points. */
  const glm::dvec3& GetHalfSize() const { return this->HalfSize; }
  /** Largest distance of a vertex from the centre; 0 if all vertices coincide or there are none. */
  double GetRadius() const { return this->Radius; }
  /**
   * Least length, over the cells with a volume, of the longest edge of a cell, in units of
   * GetRadius(); 1 without such cells.
   */
  double GetSmallestCell() const { return this->SmallestCell; }
  /** Length of the longest edge of a cell, in units of GetRadius(); 0 without cells. */
  double GetLongestEdge() const { return this->LongestEdge; }
  /** Number of cells with an edge, between different points, below ShortestPreciseEdge. */
  std::int64_t GetNumberOfImpreciseCells() const { return this->ImpreciseCells; }

private:
  class Builder;

  void Clear();
  void ForgetAllButTables();
  bool MeasurePoints(const PointsView& points, const RangeLoop& loop);
  void RoundPositions(const PointsView& points, const RangeLoop& loop);
  void MeasureCells(const PointsView& points, const RangeLoop& loop,
    std::vector<ComponentVolume>* volumes = nullptr);
  void AddVolumes(const CellMeasures& cells, std::size_t first,
    std::vector<std::pair<std::int32_t, ComponentVolume>>& runs) const;
  bool HasShortEdge(const Cell& cell, const PointsView& points) const;
  std::vector<std::int32_t> FindCoincident(const PointsView& points, const RangeLoop& loop) const;
  std::int32_t ComponentOf(std::size_t cell) const
  {
    return this->Components.empty() ? 0 : this->Components[cell];
  }
  bool TurnComponents(const std::vector<ComponentVolume>& volumes, const RangeLoop& loop);
  void LinkCells(const RangeLoop& loop);
  void OrientCells(const RangeLoop& loop);
  struct CellState;
  template <typename StateOf>
  bool ActivateCells(StateOf&& stateOf, const RangeLoop& loop);
  void MarkLinks(const std::vector<std::uint8_t>& active, const RangeLoop& loop);
  void CollectBoundary(const RangeLoop& loop);

  std::vector<Cell> Cells;
  std::vector<glm::ivec3> Positions;
  std::vector<std::int32_t> SourcePoints;
  std::vector<std::int32_t> SourceCells;
  std::vector<BoundaryFace> Boundary;
  /** IsPositivelyOriented() of each cell. */
  BitTable IsPositive;
  BitTable IsActive;
  /** Number of the connected component of each cell; empty if there is one component. */
  std::vector<std::int32_t> Components;
  std::int32_t NumberOfComponents = 0;
  /** Lowest vertex at the position of each vertex; empty if positions do not decide. */
  std::vector<std::int32_t> Coincident;
  /** False if Build() has used positions in a way that MovePoints() cannot repeat. */
  bool IsMovable = false;
  RejectedCells Rejected;
  std::int64_t CutLinks = 0;
  std::int64_t ActiveCells = 0;
  std::int64_t UnknownCells = 0;
  glm::dvec3 Center{ 0.0 };
  glm::dvec3 HalfSize{ 0.0 };
  double Radius = 0.0;
  double SmallestCell = 1.0;
  double LongestEdge = 0.0;
  std::int64_t ImpreciseCells = 0;
};

}
