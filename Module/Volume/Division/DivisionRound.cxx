// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/DivisionRound.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

/**
 * Number of equal parts whose ends are sampled. The difference of a polynomial of degree d from its
 * chord, which vanishes at both ends, vanishes everywhere if it does so at d - 1 further places:
 * three for the cubic along a trilinear cell's diagonal. Along the diagonal of a face of a cell of
 * degree n, d is 2 n.
 */
int PartsOf(int degree, bool isFirst)
{
  return isFirst ? std::max(LeastParts, 2 * degree) : LeastParts;
}

/** An edge to measure: the first piece that has it. */
struct EdgeOwner
{
  std::int32_t Piece;
  std::int32_t Edge;
};

}

//------------------------------------------------------------------------------
DivisionRound::DivisionRound(std::vector<CellPiece>& pieces, const PointFields& fields,
  const ShapeFunctionsMaker& functions, const DivisionLimits& limits, DivisionWatch& watch)
  : Pieces(pieces)
  , Fields(fields)
  , Functions(functions)
  , Limits(limits)
  , Watch(watch)
  , Points(fields.NumberOfPoints)
  , Samples(static_cast<std::size_t>(fields.NumberOfPoints))
  , Levels(static_cast<std::size_t>(fields.NumberOfPoints), 0)
{
  watch.ForEachBlock(this->Samples.size(),
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        this->Samples[p] = SampleAt(fields, static_cast<std::int32_t>(p));
      }
    });
}

//------------------------------------------------------------------------------
double DivisionRound::SquareOf(const EdgePoints& edge) const
{
  const glm::dvec3 difference = this->Samples[static_cast<std::size_t>(edge.Second)].Position -
    this->Samples[static_cast<std::size_t>(edge.First)].Position;
  return glm::dot(difference, difference);
}

//------------------------------------------------------------------------------
int DivisionRound::LevelOf(const EdgePoints& edge) const
{
  return std::max(this->Levels[static_cast<std::size_t>(edge.First)],
    this->Levels[static_cast<std::size_t>(edge.Second)]);
}

//------------------------------------------------------------------------------
DivisionRound::Wish DivisionRound::WishFor(
  const CellPiece& piece, int edge, double error, bool isBeyond) const
{
  const auto& ends = EdgeEnds[edge];
  return { EdgeOf(piece, edge), piece.Cell, isBeyond,
    { piece.Places[static_cast<std::size_t>(ends[0])],
      piece.Places[static_cast<std::size_t>(ends[1])] },
    error };
}

//------------------------------------------------------------------------------
void DivisionRound::MeasureEdges()
{
  EdgeIndex edges(this->Pieces.size());
  std::vector<EdgeOwner> owners;
  this->Watch.ForEach(this->Pieces.size(),
    [this, &edges, &owners](std::size_t p)
    {
      const CellPiece& piece = this->Pieces[p];
      for (int e = 0; piece.NewEdges != 0 && e < 6; ++e)
      {
        if ((piece.NewEdges >> e & 1) != 0 && edges.Add(EdgeOf(piece, e)))
        {
          owners.push_back({ static_cast<std::int32_t>(p), e });
        }
      }
    });
  std::vector<double> errors(owners.size(), 0.0);
  this->Watch.ForEachBlock(owners.size(),
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      ShapeTest test(this->Fields, this->Functions, this->Limits.Measure);
      for (std::size_t i = first; i < last; ++i)
      {
        const CellPiece& piece = this->Pieces[static_cast<std::size_t>(owners[i].Piece)];
        const auto& ends = EdgeEnds[owners[i].Edge];
        const auto from = static_cast<std::size_t>(ends[0]);
        const auto to = static_cast<std::size_t>(ends[1]);
        const int parts = PartsOf(piece.Degree, this->LevelOf(edges.GetEdges()[i]) == 0);
        errors[i] = test.MeasureEdge(piece.Cell, piece.Places[from], piece.Places[to],
          this->Samples[static_cast<std::size_t>(piece.Points[from])],
          this->Samples[static_cast<std::size_t>(piece.Points[to])], parts);
      }
    });
  for (std::size_t i = 0; i < owners.size(); ++i)
  {
    if (errors[i] > this->Limits.Tolerance)
    {
      this->Pending.push_back(this->WishFor(
        this->Pieces[static_cast<std::size_t>(owners[i].Piece)], owners[i].Edge, errors[i], true));
    }
    else
    {
      this->KeptError = std::max(this->KeptError, errors[i]);
    }
  }
}

//------------------------------------------------------------------------------
/** Longest edge between some corners of a piece; the first one in the order of edges of several. */
int DivisionRound::LongestEdge(const CellPiece& piece, const int* corners, int count) const
{
  int longest = -1;
  double most = -1.0;
  for (int e = 0; e < 6; ++e)
  {
    const bool has = std::count(corners, corners + count, EdgeEnds[e][0]) > 0 &&
      std::count(corners, corners + count, EdgeEnds[e][1]) > 0;
    const double square = has ? this->SquareOf(EdgeOf(piece, e)) : -1.0;
    if (has && (square > most || (square == most && EdgeOf(piece, e) < EdgeOf(piece, longest))))
    {
      longest = e;
      most = square;
    }
  }
  return longest;
}

//------------------------------------------------------------------------------
/**
 * Measures the faces and the insides of new pieces of cells with a high degree, and the insides of
 * all new pieces if there are surfaces: differences in edges that no surface meets count there.
 */
void DivisionRound::MeasureInside()
{
  constexpr int corners[4] = { 0, 1, 2, 3 };
  const bool hasSurfaces = this->Limits.Measure.HasSurfaces;
  struct Found
  {
    std::vector<Wish> Wishes;
    double Kept = 0.0;
  };
  std::vector<Found> found(NumberOfBlocks(this->Pieces.size()));
  this->Watch.ForEachBlock(this->Pieces.size(),
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      ShapeTest test(this->Fields, this->Functions, this->Limits.Measure);
      for (std::size_t p = first; p < last; ++p)
      {
        const CellPiece& piece = this->Pieces[p];
        const auto measure = [&](const int* places, int count)
        {
          const double error = test.MeasureMiddle(piece, places, count, this->Samples);
          if (error > this->Limits.Tolerance)
          {
            const int edge = this->LongestEdge(piece, places, count);
            found[block].Wishes.push_back(this->WishFor(piece, edge, error, true));
          }
          else
          {
            found[block].Kept = std::max(found[block].Kept, error);
          }
        };
        const bool hasFaces = piece.Degree > 2 && piece.NewEdges != 0;
        for (const auto& face : PieceFaces)
        {
          if (hasFaces)
          {
            measure(face.Corners, 3);
          }
        }
        if (hasFaces || (hasSurfaces && piece.Degree > 0 && piece.NewEdges != 0))
        {
          measure(corners, 4);
        }
      }
    });
  for (const Found& some : found)
  {
    this->Pending.insert(this->Pending.end(), some.Wishes.begin(), some.Wishes.end());
    this->KeptError = std::max(this->KeptError, some.Kept);
  }
}

//------------------------------------------------------------------------------
void DivisionRound::Measure()
{
  this->MeasureEdges();
  this->MeasureInside();
  for (CellPiece& piece : this->Pieces)
  {
    piece.NewEdges = 0;
  }
}

//------------------------------------------------------------------------------
double DivisionRound::ChooseThreshold() const
{
  // Half of the room: neighbours are divided, too.
  const double room = 0.5 *
    static_cast<double>(this->Limits.MostPieces - static_cast<std::int64_t>(this->Pieces.size()));
  // Pieces around an edge for which it has the largest error.
  constexpr double perEdge = 2.0;
  constexpr double step = 1.2;
  double threshold = this->Limits.Tolerance;
  const auto countAdded = [this](double error)
  {
    double added = 0.0;
    for (const Wish& wish : this->Pending)
    {
      const double ratio = wish.Error / error;
      added += ratio > 1.0 ? perEdge * (ratio * std::sqrt(ratio) - 1.0) : 0.0;
    }
    return added;
  };
  while (countAdded(threshold) > room)
  {
    threshold *= step;
  }
  return threshold;
}

//------------------------------------------------------------------------------
/**
 * Adds the longest edges of triangles with an edge to divide that follows many halvings. A part of
 * an edge may be beyond the limits although the edge is within them: the two
 * shorter sides of a triangle would then be halved in turns for ever, since the points that this
 * adds approach a third of the longest side, which stays whole. Pieces that are linear are left
 * out: their edges are halved for their neighbours only, and the points that this adds lie where
 * the neighbours' shape functions say.
 */
void DivisionRound::AddLongEdges(std::vector<Wish>& wishes, double error)
{
  // Halvings that lead to pieces in proportion reach edges of a thousandth of a cell by then.
  constexpr int many = 10;
  EdgeIndex late;
  for (const Wish& wish : wishes)
  {
    if (this->LevelOf(wish.Edge) >= many)
    {
      late.Add(wish.Edge);
    }
  }
  this->Watch.ForEach(late.GetSize() > 0 ? this->Pieces.size() : 0,
    [this, &late, &wishes, error](std::size_t p)
    {
      const CellPiece& piece = this->Pieces[p];
      for (const auto& face : PieceFaces)
      {
        const bool isLate = piece.Degree > 0 &&
          (late.Find(EdgeOf(piece, face.Edges[0])) != EdgeIndex::None ||
            late.Find(EdgeOf(piece, face.Edges[1])) != EdgeIndex::None ||
            late.Find(EdgeOf(piece, face.Edges[2])) != EdgeIndex::None);
        if (isLate)
        {
          const int edge = this->LongestEdge(piece, face.Corners, 3);
          wishes.push_back(this->WishFor(piece, edge, error, false));
        }
      }
    });
}

//------------------------------------------------------------------------------
bool DivisionRound::Mark(double threshold)
{
  const auto chosen = std::stable_partition(this->Pending.begin(), this->Pending.end(),
    [threshold](const Wish& wish) { return !(wish.Error > threshold); });
  std::vector<Wish> wishes(chosen, this->Pending.end());
  this->Pending.erase(chosen, this->Pending.end());
  this->AddLongEdges(wishes, threshold);
  // The first wish for an edge has its largest error, and is one beyond the limits if there is one.
  std::stable_sort(wishes.begin(), wishes.end(),
    [](const Wish& a, const Wish& b)
    {
      return a.Edge == b.Edge
        ? std::make_pair(!a.IsBeyond, -a.Error) < std::make_pair(!b.IsBeyond, -b.Error)
        : a.Edge < b.Edge;
    });
  const auto last = std::unique(
    wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.Edge == b.Edge; });
  wishes.erase(last, wishes.end());
  const auto isFinal = [this](const Wish& wish)
  { return this->LevelOf(wish.Edge) >= this->Limits.MostLevels; };
  for (const Wish& wish : wishes)
  {
    if (wish.IsBeyond && isFinal(wish))
    {
      this->Unresolved.Add(wish.Edge);
      this->KeptError = std::max(this->KeptError, wish.Error);
    }
  }
  wishes.erase(std::remove_if(wishes.begin(), wishes.end(), isFinal), wishes.end());
  this->MarkWishes(wishes);
  return this->Marked.GetSize() > 0;
}

//------------------------------------------------------------------------------
/** @param wishes in ascending order of their edges. */
void DivisionRound::MarkWishes(const std::vector<Wish>& wishes)
{
  this->Wishes = wishes;
  this->Marked = EdgeIndex(wishes.size());
  this->Squares.clear();
  this->Touched.assign(this->Samples.size(), 0);
  for (const Wish& wish : wishes)
  {
    this->Marked.Add(wish.Edge);
    this->Squares.push_back(this->SquareOf(wish.Edge));
    this->Touched[static_cast<std::size_t>(wish.Edge.First)] = 1;
    this->Touched[static_cast<std::size_t>(wish.Edge.Second)] = 1;
  }
}

//------------------------------------------------------------------------------
std::array<std::int32_t, 6> DivisionRound::MarksOf(const CellPiece& piece) const
{
  std::array<std::int32_t, 6> marks{};
  for (int e = 0; e < 6; ++e)
  {
    const EdgePoints edge = EdgeOf(piece, e);
    // Points that this round has added are in no marked edge.
    const auto second = static_cast<std::size_t>(edge.Second);
    const bool isTouched = second < this->Touched.size() && this->Touched[second] != 0 &&
      this->Touched[static_cast<std::size_t>(edge.First)] != 0;
    marks[static_cast<std::size_t>(e)] = isTouched ? this->Marked.Find(edge) : EdgeIndex::None;
  }
  return marks;
}

//------------------------------------------------------------------------------
int DivisionRound::FirstCut(const std::array<std::int32_t, 6>& marks) const
{
  int cut = -1;
  for (int e = 0; e < 6; ++e)
  {
    const std::int32_t found = marks[static_cast<std::size_t>(e)];
    if (found == EdgeIndex::None)
    {
      continue;
    }
    const std::int32_t longest = cut < 0 ? found : marks[static_cast<std::size_t>(cut)];
    const double square = this->Squares[static_cast<std::size_t>(found)];
    const double most = this->Squares[static_cast<std::size_t>(longest)];
    cut = cut < 0 || square > most || (square == most && found < longest) ? e : cut;
  }
  return cut;
}

//------------------------------------------------------------------------------
/**
 * Number of pieces after the split. A piece with n marked edges becomes n + 1 pieces, and one more
 * if the edge opposite to the first cut is marked, which both halves have.
 */
std::int64_t DivisionRound::CountParts()
{
  std::vector<std::int64_t> counts(NumberOfBlocks(this->Pieces.size()), 0);
  this->Watch.ForEachBlock(this->Pieces.size(),
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        const std::array<std::int32_t, 6> marks = this->MarksOf(this->Pieces[p]);
        const int cut = this->FirstCut(marks);
        const bool hasOpposite =
          cut >= 0 && marks[static_cast<std::size_t>(OppositeEdge(cut))] != EdgeIndex::None;
        counts[block] += 7 - std::count(marks.begin(), marks.end(), EdgeIndex::None) + hasOpposite;
      }
    });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
}

//------------------------------------------------------------------------------
bool DivisionRound::FitBudget()
{
  const std::size_t count = this->Wishes.size();
  const bool pointsFit = this->Samples.size() + count <= std::numeric_limits<std::int32_t>::max();
  // A piece becomes eight at most.
  const bool certain =
    8 * static_cast<std::int64_t>(this->Pieces.size()) <= this->Limits.MostPieces;
  if (pointsFit && (certain || this->CountParts() <= this->Limits.MostPieces))
  {
    return true;
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(),
    [this](std::size_t a, std::size_t b) { return this->Wishes[a].Error > this->Wishes[b].Error; });
  std::vector<std::size_t> ranks(count);
  for (std::size_t rank = 0; rank < count; ++rank)
  {
    ranks[order[rank]] = rank;
  }
  // Pieces that each rank adds, at most: one per piece with the edge, and one per opposite edge.
  std::vector<std::int64_t> added(count, 0);
  this->Watch.ForEach(this->Pieces.size(),
    [this, &ranks, &added](std::size_t p)
    {
      const std::array<std::int32_t, 6> marks = this->MarksOf(this->Pieces[p]);
      for (int e = 0; e < 6; ++e)
      {
        const std::int32_t mark = marks[static_cast<std::size_t>(e)];
        const std::int32_t other = marks[static_cast<std::size_t>(OppositeEdge(e))];
        if (mark != EdgeIndex::None)
        {
          const std::size_t rank = ranks[static_cast<std::size_t>(mark)];
          const bool isSecond =
            other != EdgeIndex::None && ranks[static_cast<std::size_t>(other)] < rank;
          added[rank] += isSecond ? 2 : 1;
        }
      }
    });
  std::int64_t pieces = static_cast<std::int64_t>(this->Pieces.size());
  std::size_t kept = 0;
  while (pointsFit && kept < count && pieces + added[kept] <= this->Limits.MostPieces)
  {
    pieces += added[kept++];
  }
  std::vector<Wish> wishes;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (ranks[i] < kept)
    {
      wishes.push_back(this->Wishes[i]);
    }
    else if (this->Wishes[i].IsBeyond)
    {
      this->Pending.push_back(this->Wishes[i]);
    }
  }
  this->MarkWishes(wishes);
  return false;
}

//------------------------------------------------------------------------------
void DivisionRound::AddPoints()
{
  const std::size_t count = this->Wishes.size();
  const std::size_t first = this->Samples.size();
  this->Samples.resize(first + count);
  std::vector<WeightedPoints> rows(
    NumberOfBlocks(count), WeightedPoints(this->Fields.NumberOfPoints));
  this->Watch.ForEachBlock(count,
    [&](std::size_t block, std::size_t begin, std::size_t end)
    {
      CellSampler sampler(this->Fields, this->Functions);
      for (std::size_t i = begin; i < end; ++i)
      {
        const Wish& wish = this->Wishes[i];
        const PointWeights& row =
          sampler.Weigh(wish.Cell, 0.5 * (glm::dvec3(wish.Places[0]) + glm::dvec3(wish.Places[1])));
        rows[block].Add(row);
        this->Samples[first + i] = SampleOf(this->Fields, row);
      }
    });
  for (const WeightedPoints& some : rows)
  {
    this->Points.Append(some);
  }
  for (const Wish& wish : this->Wishes)
  {
    this->Levels.push_back(static_cast<std::uint8_t>(this->LevelOf(wish.Edge) + 1));
  }
}

//------------------------------------------------------------------------------
/** Halves a piece, and its halves, at the longest marked edge until there is none. */
void DivisionRound::SplitPiece(const CellPiece& piece, std::vector<CellPiece>& parts) const
{
  const std::array<std::int32_t, 6> marks = this->MarksOf(piece);
  const int cut = this->FirstCut(marks);
  if (cut < 0)
  {
    parts.push_back(piece);
    return;
  }
  const auto& ends = EdgeEnds[cut];
  const auto from = static_cast<std::size_t>(ends[0]);
  const auto to = static_cast<std::size_t>(ends[1]);
  const glm::vec3 middle = 0.5f * (piece.Places[from] + piece.Places[to]);
  const auto newPoint =
    static_cast<std::int32_t>(this->Touched.size()) + marks[static_cast<std::size_t>(cut)];
  for (const std::size_t replaced : { to, from })
  {
    CellPiece half = piece;
    half.Points[replaced] = newPoint;
    half.Places[replaced] = middle;
    for (int e = 0; half.Degree > 0 && e < 6; ++e)
    {
      const bool isNew = EdgeEnds[e][0] == static_cast<int>(replaced) ||
        EdgeEnds[e][1] == static_cast<int>(replaced);
      half.NewEdges = static_cast<std::uint8_t>(half.NewEdges | (isNew ? 1 << e : 0));
    }
    this->SplitPiece(half, parts);
  }
}

//------------------------------------------------------------------------------
void DivisionRound::Split()
{
  std::vector<std::vector<CellPiece>> parts(NumberOfBlocks(this->Pieces.size()));
  this->Watch.ForEachBlock(this->Pieces.size(),
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        this->SplitPiece(this->Pieces[p], parts[block]);
      }
    });
  std::size_t size = 0;
  for (const std::vector<CellPiece>& some : parts)
  {
    size += some.size();
  }
  this->Pieces.clear();
  this->Pieces.reserve(size);
  for (std::vector<CellPiece>& some : parts)
  {
    this->Pieces.insert(this->Pieces.end(), some.begin(), some.end());
    some = std::vector<CellPiece>();
  }
}

//------------------------------------------------------------------------------
DivisionRound::State DivisionRound::Save() const
{
  return { this->Pieces, this->Pending, this->Unresolved, this->Points.GetSize(), this->KeptError,
    this->GetError() };
}

//------------------------------------------------------------------------------
void DivisionRound::Restore(const State& state)
{
  this->Pieces = state.Pieces;
  this->Pending = state.Pending;
  this->Unresolved = state.Unresolved;
  this->KeptError = state.KeptError;
  this->Points.Shrink(state.Points);
  const auto points = static_cast<std::size_t>(this->Fields.NumberOfPoints + state.Points);
  this->Samples.resize(points);
  this->Levels.resize(points);
}

//------------------------------------------------------------------------------
double DivisionRound::GetError() const
{
  double most = this->KeptError;
  for (const Wish& wish : this->Pending)
  {
    most = std::max(most, wish.Error);
  }
  return most;
}

}
