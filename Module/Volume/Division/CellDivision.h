// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Division/CellPiece.h"
#include "Volume/Division/DivisionLimits.h"
#include "Volume/Division/ShapeFunctions.h"
#include "Volume/Division/WeightedPoints.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

class DivisionWatch;

enum class DivisionStatus
{
  Ok,
  Aborted
};

/** Numbers that a division reports. */
struct DivisionCounts
{
  std::int64_t Pieces = 0;
  /** Edges beyond the tolerance that were not divided, because of MostLevels. */
  std::int64_t UnresolvedEdges = 0;
  /** Cells that are folded: pieces with either orientation overlap by more than the tolerance. */
  std::int64_t FoldedCells = 0;
  /** Largest error in the edges of the pieces. */
  double Error = 0.0;
  /** False if the budget ended the division before that. */
  bool ReachedTolerance = true;
};

/**
 * Divides cells into tetrahedra until linear interpolation in them is accurate, or a budget of
 * pieces is spent: the error of an edge is the distance of the curve from its chord, or the
 * difference of a value from that on the chord, as the measure weighs them.
 *
 * The cells are given as tetrahedra between their corners, which match across shared faces; so do
 * the pieces, whatever the types of the cells. The result does not depend on the number of threads.
 * Documentation/true-cells.md, "How it works", has the rules.
 */
class CellDivision
{
public:
  /**
   * Divides the cells, which replaces earlier results.
   * @param pieces tetrahedra of the cells; the pieces of one cell follow each other.
   * @param progress called several times per round, and every 131,072 edges or pieces, with the
   *   fraction done, an estimate, since the number of rounds is not known; returns false to abort.
   *   Always on the calling thread.
   */
  DivisionStatus Divide(std::vector<CellPiece> pieces, const PointFields& fields,
    const ShapeFunctionsMaker& functions, const DivisionLimits& limits, const RangeLoop& loop,
    const std::function<bool(double)>& progress);

  /**
   * True if the errors in the edges of the pieces are within a limit, for other positions or values
   * of the points or another measure.
   */
  bool Holds(const PointFields& fields, const ShapeFunctionsMaker& functions,
    const DivisionMeasure& measure, double most, const RangeLoop& loop) const;

  const std::vector<CellPiece>& GetPieces() const { return this->Pieces; }
  /** Frees the pieces. Holds() does not need them. */
  void ForgetPieces() { this->Pieces = std::vector<CellPiece>(); }
  const WeightedPoints& GetPoints() const { return this->Points; }
  const DivisionCounts& GetCounts() const { return this->Counts; }
  std::int64_t GetBytes() const;

private:
  /** An edge of the last pieces, in a cell that is not linear. */
  struct TestedEdge
  {
    std::array<glm::vec3, 2> Places;
    std::int32_t Cell;
  };

  void KeepEdges(DivisionWatch& watch);
  void CountFolded(const std::vector<CellSample>& samples, double tolerance);

  std::vector<CellPiece> Pieces;
  WeightedPoints Points;
  std::vector<TestedEdge> Edges;
  DivisionCounts Counts;
};

}
