// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/CellDivision.h"

#include "Common/BlockLoop.h"
#include "Volume/Division/DivisionRound.h"
#include "Volume/Division/DivisionWatch.h"
#include "Volume/Division/ShapeTest.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

constexpr std::uint8_t EveryEdge = 0x3F;

/**
 * Splits the pieces until their errors are within the tolerance or the budget is spent; in that
 * case the errors are as small as it allows. Returns false after an abort.
 */
bool Refine(DivisionRound& round, const DivisionLimits& limits, DivisionWatch& watch,
  const std::vector<CellPiece>& pieces)
{
  const auto hasRoom = [&]()
  { return static_cast<std::int64_t>(pieces.size()) < limits.MostPieces; };
  // A threshold that takes less than the budget is lowered by this factor at least. One that takes
  // more is raised towards the error that has been reached, unless they are as close as that.
  constexpr double step = 0.8;
  int attempts = 4;
  double threshold = std::numeric_limits<double>::infinity();
  DivisionRound::State reached = round.Save();
  bool fits = true;
  while (fits && round.HasPending() && hasRoom())
  {
    threshold = std::max(limits.Tolerance, std::min(round.ChooseThreshold(), step * threshold));
    for (bool isMarked = true; fits && isMarked;)
    {
      const bool goesOn = watch.Run(0.5,
        [&]()
        {
          isMarked = round.Mark(threshold);
          fits = !isMarked || round.FitBudget();
        });
      if (!goesOn)
      {
        return false;
      }
      if (!fits && threshold < step * reached.Error && attempts-- > 0)
      {
        fits = true;
        round.Restore(reached);
        threshold = std::sqrt(threshold * reached.Error);
        continue;
      }
      const auto split = [&round]()
      {
        round.Split();
        round.Measure();
      };
      if (isMarked &&
        !(watch.Run(0.25, [&round]() { round.AddPoints(); }) && watch.Run(0.25, split)))
      {
        return false;
      }
    }
    if (fits)
    {
      reached = round.Save();
    }
  }
  // The rest of the budget may have led to edges with larger errors.
  if (!fits && round.GetError() > reached.Error)
  {
    round.Restore(reached);
  }
  return true;
}

}

//------------------------------------------------------------------------------
DivisionStatus CellDivision::Divide(std::vector<CellPiece> pieces, const PointFields& fields,
  const ShapeFunctionsMaker& functions, const DivisionLimits& limits, const RangeLoop& loop,
  const std::function<bool(double)>& progress)
{
  this->Pieces = std::move(pieces);
  this->Counts = DivisionCounts();
  for (CellPiece& piece : this->Pieces)
  {
    piece.NewEdges = piece.Degree > 0 ? EveryEdge : 0;
  }
  DivisionWatch watch(loop, progress);
  DivisionRound round(this->Pieces, fields, functions, limits, watch);
  if (!watch.Run(0.25, [&round]() { round.Measure(); }))
  {
    return DivisionStatus::Aborted;
  }
  if (!Refine(round, limits, watch, this->Pieces))
  {
    return DivisionStatus::Aborted;
  }
  this->Counts.Error = round.GetError();
  this->Counts.ReachedTolerance = !round.HasPending();
  this->Points = std::move(round.GetPoints());
  this->Counts.Pieces = static_cast<std::int64_t>(this->Pieces.size());
  this->Counts.UnresolvedEdges = round.GetNumberOfUnresolved();
  const double place = limits.Measure.OfPlace > 0.0 ? limits.Tolerance / limits.Measure.OfPlace
                                                    : std::numeric_limits<double>::infinity();
  const auto finish = [&]()
  {
    this->CountFolded(round.GetSamples(), place);
    this->KeepEdges(watch);
  };
  return watch.Run(0.25, finish) ? DivisionStatus::Ok : DivisionStatus::Aborted;
}

//------------------------------------------------------------------------------
/** Counts the cells with pieces of either orientation. */
void CellDivision::CountFolded(const std::vector<CellSample>& samples, double tolerance)
{
  // A quadratic shape differs from its interpolation in a piece by at most 3/2 of the largest
  // difference in an edge: sum(4 li lj) over the six edges, with barycentric coordinates of 1/4. So
  // a piece of a shape that is not folded is turned by no more than twice that height.
  const double harmless = 3.0 * tolerance;
  std::size_t first = 0;
  while (first < this->Pieces.size())
  {
    const std::int32_t cell = this->Pieces[first].Cell;
    double volume = 0.0;
    double heights[2] = { 0.0, 0.0 };
    for (; first < this->Pieces.size() && this->Pieces[first].Cell == cell; ++first)
    {
      const CellPiece& piece = this->Pieces[first];
      const auto spanOf = [](const auto& a, const auto& b, const auto& c, const auto& d)
      { return glm::dmat3(glm::dvec3(b - a), glm::dvec3(c - a), glm::dvec3(d - a)); };
      const auto at = [&](std::size_t i)
      { return samples[static_cast<std::size_t>(piece.Points[i])].Position; };
      const auto& p = piece.Places;
      const double inside = glm::determinant(spanOf(p[0], p[1], p[2], p[3]));
      const double signedVolume =
        glm::determinant(spanOf(at(0), at(1), at(2), at(3))) * (inside < 0.0 ? -1.0 : 1.0);
      double largestFace = glm::length(glm::cross(at(2) - at(1), at(3) - at(1)));
      for (const auto& face : { std::array<std::size_t, 3>{ 0, 1, 2 }, { 0, 1, 3 }, { 0, 2, 3 } })
      {
        largestFace = std::max(largestFace,
          glm::length(glm::cross(at(face[1]) - at(face[0]), at(face[2]) - at(face[0]))));
      }
      volume += signedVolume;
      const double height = largestFace > 0.0 ? std::abs(signedVolume) / largestFace : 0.0;
      double& highest = heights[signedVolume > 0.0 ? 1 : 0];
      highest = piece.Degree > 0 ? std::max(highest, height) : highest;
    }
    this->Counts.FoldedCells += heights[volume > 0.0 ? 0 : 1] > harmless;
  }
}

//------------------------------------------------------------------------------
void CellDivision::KeepEdges(DivisionWatch& watch)
{
  EdgeIndex edges(2 * this->Pieces.size());
  this->Edges.clear();
  watch.ForEach(this->Pieces.size(),
    [this, &edges](std::size_t p)
    {
      const CellPiece& piece = this->Pieces[p];
      for (int e = 0; piece.Degree > 0 && e < 6; ++e)
      {
        if (edges.Add(EdgeOf(piece, e)))
        {
          this->Edges.push_back({ { piece.Places[static_cast<std::size_t>(EdgeEnds[e][0])],
                                    piece.Places[static_cast<std::size_t>(EdgeEnds[e][1])] },
            piece.Cell });
        }
      }
    });
  this->Edges.shrink_to_fit();
}

//------------------------------------------------------------------------------
bool CellDivision::Holds(const PointFields& fields, const ShapeFunctionsMaker& functions,
  const DivisionMeasure& measure, double most, const RangeLoop& loop) const
{
  std::atomic<bool> holds(true);
  ForEachBlock(this->Edges.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      ShapeTest test(fields, functions, measure);
      for (std::size_t i = first; i < last && holds.load(std::memory_order_relaxed); ++i)
      {
        const TestedEdge& edge = this->Edges[i];
        if (test.MeasureEdge(edge.Cell, edge.Places[0], edge.Places[1], LeastParts) > most)
        {
          holds.store(false, std::memory_order_relaxed);
        }
      }
    });
  return holds.load();
}

//------------------------------------------------------------------------------
std::int64_t CellDivision::GetBytes() const
{
  return static_cast<std::int64_t>(this->Pieces.capacity() * sizeof(CellPiece) +
           this->Edges.capacity() * sizeof(TestedEdge)) +
    this->Points.GetBytes();
}

}
