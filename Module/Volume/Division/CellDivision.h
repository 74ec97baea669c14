// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Division_CellDivision_h
#define meniscus_Volume_Division_CellDivision_h

#include "Common/RangeLoop.h"
#include "Volume/Division/CellPiece.h"
#include "Volume/Division/EdgeIndex.h"
#include "Volume/Division/ShapeFunctions.h"
#include "Volume/Division/ShapeTest.h"
#include "Volume/Division/WeightedPoints.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

enum class DivisionStatus
{
  Ok,
  /** More pieces or points than wanted, or than 32 bits can index. */
  TooLarge,
  Aborted
};

/** Numbers that a division reports. */
struct DivisionCounts
{
  std::int64_t Pieces = 0;
  /** Edges that were divided: as many as there are new points. */
  std::int64_t DividedEdges = 0;
  /** Edges found beyond the tolerance that were not divided, because of MostLevels. */
  std::int64_t UnresolvedEdges = 0;
  /** Cells that are folded: pieces with either orientation overlap by more than the tolerance. */
  std::int64_t FoldedCells = 0;
};

/**
 * Divides cells into tetrahedra until linear interpolation in them is accurate: in each edge, the
 * distance of the curve from its chord, and the difference of each value from that on the chord,
 * are within the limits.
 *
 * The cells are given as tetrahedra between their corners, which match across shared faces. In each
 * round all edges that have not been tested are sampled (three places; more in the first pieces of
 * cells of a high degree); so are faces and pieces of cells with a degree above 2, whose shape
 * functions may vanish on all edges: they mark their longest edge. Then each piece with marked
 * edges is halved at the longest of these, and so on. The rule is one order of all edges, so the
 * triangles of a shared face are the same on both sides: the first marked edge of a piece that lies
 * in the face is the first one of the face, whichever other edges the piece has. No neighbours
 * crack, whatever their types. A new point is the middle of its edge in reference coordinates.
 *
 * The result does not depend on the number of threads.
 */
class CellDivision
{
public:
  /**
   * Divides the cells, which replaces earlier results.
   * @param pieces tetrahedra of the cells; those of one cell follow each other.
   * @param progress called several times per round with the fraction done, an estimate, since the
   *   number of rounds is not known; returns false to abort.
   */
  DivisionStatus Divide(std::vector<CellPiece> pieces, const PointFields& fields,
    const ShapeFunctionsMaker& functions, const DivisionLimits& limits, const RangeLoop& loop,
    const std::function<bool(double)>& progress);

  /**
   * True if the edges of the pieces are within the limits for other positions or values of the
   * points.
   */
  bool Holds(const PointFields& fields, const ShapeFunctionsMaker& functions,
    const DivisionLimits& limits, const RangeLoop& loop) const;

  const std::vector<CellPiece>& GetPieces() const { return this->Pieces; }
  /** Frees the pieces. Holds() does not need them. */
  void ForgetPieces() { this->Pieces = std::vector<CellPiece>(); }
  const WeightedPoints& GetPoints() const { return this->Points; }
  const DivisionCounts& GetCounts() const { return this->Counts; }
  std::int64_t GetBytes() const;

private:
  class Round;

  /** An edge of the last pieces, in a cell that is not linear. */
  struct TestedEdge
  {
    std::array<glm::vec3, 2> Places;
    std::int32_t Cell;
  };

  void KeepEdges();
  void CountFolded(const std::vector<CellSample>& samples, double tolerance);

  std::vector<CellPiece> Pieces;
  WeightedPoints Points;
  std::vector<TestedEdge> Edges;
  DivisionCounts Counts;
};

}

#endif
