// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Division/CellPiece.h"
#include "Volume/Division/DivisionLimits.h"
#include "Volume/Division/DivisionWatch.h"
#include "Volume/Division/EdgeIndex.h"
#include "Volume/Division/ShapeFunctions.h"
#include "Volume/Division/ShapeTest.h"
#include "Volume/Division/WeightedPoints.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** State of a division in progress, and the steps of a round. */
class DivisionRound
{
  /** An edge to divide. */
  struct Wish
  {
    EdgePoints Edge;
    std::int32_t Cell;
    /** False for an edge that is within the tolerance, and divided for the shape of the pieces. */
    bool IsBeyond;
    /** Reference coordinates of the ends. */
    std::array<glm::vec3, 2> Places;
    double Error;
  };

public:
  /** State between rounds. */
  struct State
  {
    std::vector<CellPiece> Pieces;
    std::vector<Wish> Pending;
    EdgeIndex Unresolved;
    /** Number of new points. */
    std::int64_t Points;
    double KeptError;
    /** As GetError(). */
    double Error;
  };

  /** @param pieces source of the cells to divide. All arguments must outlive this object. */
  DivisionRound(std::vector<CellPiece>& pieces, const PointFields& fields,
    const ShapeFunctionsMaker& functions, const DivisionLimits& limits, DivisionWatch& watch);

  /** Measures all edges that have not been measured. Those beyond the tolerance become pending. */
  void Measure();
  bool HasPending() const { return !this->Pending.empty(); }
  /**
   * Error for which the budget is likely to be enough: the tolerance, or a larger one. The
   * prediction is that an edge with the error e, divided until e is t, takes (e / t)^1.5 pieces:
   * halving quarters the error, in three directions.
   */
  double ChooseThreshold() const;
  /** Marks all pending edges with errors above a threshold. Returns false if there are none. */
  bool Mark(double threshold);
  /**
   * Keeps the marks with the largest errors, as many as the budget allows. Returns false if it does
   * not allow all of them.
   */
  bool FitBudget();
  void AddPoints();
  /** Halves pieces at marked edges. */
  void Split();

  State Save() const;
  /** Goes back to an earlier state. */
  void Restore(const State& state);

  /** Largest error in the edges of the pieces. */
  double GetError() const;
  std::int64_t GetNumberOfUnresolved() const
  {
    return static_cast<std::int64_t>(this->Unresolved.GetSize());
  }
  WeightedPoints& GetPoints() { return this->Points; }
  const std::vector<CellSample>& GetSamples() const { return this->Samples; }

private:
  void MeasureEdges();
  void MeasureInside();
  void AddLongEdges(std::vector<Wish>& wishes, double error);
  void MarkWishes(const std::vector<Wish>& wishes);
  Wish WishFor(const CellPiece& piece, int edge, double error, bool isBeyond) const;
  int LongestEdge(const CellPiece& piece, const int* corners, int count) const;
  double SquareOf(const EdgePoints& edge) const;
  int LevelOf(const EdgePoints& edge) const;
  /** Numbers of the marked edges of a piece, or EdgeIndex::None. */
  std::array<std::int32_t, 6> MarksOf(const CellPiece& piece) const;
  /** The longest marked edge of a piece; -1 without. */
  int FirstCut(const std::array<std::int32_t, 6>& marks) const;
  std::int64_t CountParts();
  void SplitPiece(const CellPiece& piece, std::vector<CellPiece>& parts) const;

  std::vector<CellPiece>& Pieces;
  const PointFields& Fields;
  const ShapeFunctionsMaker& Functions;
  const DivisionLimits& Limits;
  DivisionWatch& Watch;
  WeightedPoints Points;
  /** Samples at all points: each point is an end of many edges. */
  std::vector<CellSample> Samples;
  /** Number of halvings that made each point, at most. */
  std::vector<std::uint8_t> Levels;
  /** Edges beyond the tolerance that are not divided yet; an edge may be there more than once. */
  std::vector<Wish> Pending;
  /** Edges that this round divides, in ascending order, with their squared lengths. */
  EdgeIndex Marked;
  std::vector<Wish> Wishes;
  std::vector<double> Squares;
  /** 1 for points of marked edges. */
  std::vector<std::uint8_t> Touched;
  /** Edges beyond the tolerance that are not divided, because of MostLevels. */
  EdgeIndex Unresolved;
  /** Largest error that is not pending. */
  double KeptError = 0.0;
};

}
