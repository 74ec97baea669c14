// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/CellDivision.h"

#include "Common/BlockLoop.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace meniscus
{
namespace
{

constexpr std::uint8_t EveryEdge = 0x3F;

/**
 * Number of equal parts whose ends are sampled. The difference of a polynomial of degree d from its
 * chord, which vanishes at both ends, vanishes everywhere if it does so at d - 1 further places:
 * three for the cubic along a trilinear cell's diagonal. Along the diagonal of a face of a cell of
 * degree n, d is 2 n.
 */
int PartsOf(int degree, bool isFirst)
{
  constexpr int least = 4;
  return isFirst ? std::max(least, 2 * degree) : least;
}

/** An edge to test: the first piece that has it. */
struct EdgeOwner
{
  std::int32_t Piece;
  std::int32_t Edge;
};

}

//------------------------------------------------------------------------------
/** State of a division in progress. */
class CellDivision::Round
{
public:
  Round(std::vector<CellPiece>& pieces, const PointFields& fields,
    const ShapeFunctionsMaker& functions, const DivisionLimits& limits, const RangeLoop& loop)
    : Pieces(pieces)
    , Fields(fields)
    , Functions(functions)
    , Limits(limits)
    , Loop(loop)
    , Points(fields.NumberOfPoints)
    , Samples(static_cast<std::size_t>(fields.NumberOfPoints))
    , Levels(static_cast<std::size_t>(fields.NumberOfPoints), 0)
  {
    ForEachBlock(this->Samples.size(), loop,
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t p = first; p < last; ++p)
        {
          this->Samples[p] = SampleAt(fields, static_cast<std::int32_t>(p));
        }
      });
  }

  /** Returns false if no edge is to be divided. */
  bool Mark();
  /** False if dividing the marked edges makes too many pieces or points. */
  bool HasRoom() const;
  void AddPoints();
  /** Returns false if there are too many pieces. */
  bool Split();

  std::int64_t GetNumberOfUnresolved() const
  {
    return static_cast<std::int64_t>(this->Unresolved.GetSize());
  }
  WeightedPoints& GetPoints() { return this->Points; }
  const std::vector<CellSample>& GetSamples() const { return this->Samples; }

private:
  struct Wish
  {
    EdgePoints Edge;
    EdgeOwner Owner;
    /** True for an edge, or the longest one of a face or piece, beyond the limits. */
    bool IsBeyond;
  };

  void TestEdges(std::vector<Wish>& wishes);
  void TestInside(std::vector<Wish>& wishes) const;
  void AddLongEdges(std::vector<Wish>& wishes) const;
  void AddInside(ShapeTest& test, std::int32_t number, const int* corners, int count,
    std::vector<Wish>& wishes) const;
  int LongestEdge(const CellPiece& piece, const int* corners, int count) const;
  double SquareOf(const EdgePoints& edge) const;
  int LevelOf(const EdgePoints& edge) const;
  void SplitPiece(const CellPiece& piece, std::vector<CellPiece>& parts) const;

  std::vector<CellPiece>& Pieces;
  const PointFields& Fields;
  const ShapeFunctionsMaker& Functions;
  const DivisionLimits& Limits;
  const RangeLoop& Loop;
  WeightedPoints Points;
  /** Samples at all points: each point is an end of many edges. */
  std::vector<CellSample> Samples;
  /** Number of halvings that made each point, at most. */
  std::vector<std::uint8_t> Levels;
  /** Edges that this round divides, in ascending order, with their squared lengths. */
  EdgeIndex Marked;
  std::vector<EdgeOwner> Owners;
  std::vector<double> Squares;
  /** 1 for points of marked edges. */
  std::vector<std::uint8_t> Touched;
  /** Edges beyond the limits that are not divided. */
  EdgeIndex Unresolved;
};

//------------------------------------------------------------------------------
double CellDivision::Round::SquareOf(const EdgePoints& edge) const
{
  const glm::dvec3 difference = this->Samples[static_cast<std::size_t>(edge.Second)].Position -
    this->Samples[static_cast<std::size_t>(edge.First)].Position;
  return glm::dot(difference, difference);
}

//------------------------------------------------------------------------------
int CellDivision::Round::LevelOf(const EdgePoints& edge) const
{
  return std::max(this->Levels[static_cast<std::size_t>(edge.First)],
    this->Levels[static_cast<std::size_t>(edge.Second)]);
}

//------------------------------------------------------------------------------
void CellDivision::Round::TestEdges(std::vector<Wish>& wishes)
{
  EdgeIndex edges(this->Pieces.size());
  std::vector<EdgeOwner> owners;
  for (std::size_t p = 0; p < this->Pieces.size(); ++p)
  {
    CellPiece& piece = this->Pieces[p];
    for (int e = 0; piece.NewEdges != 0 && e < 6; ++e)
    {
      if ((piece.NewEdges >> e & 1) != 0 && edges.Add(EdgeOf(piece, e)))
      {
        owners.push_back({ static_cast<std::int32_t>(p), e });
      }
    }
  }
  std::vector<std::uint8_t> bent(owners.size(), 0);
  ForEachBlock(owners.size(), this->Loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      ShapeTest test(this->Fields, this->Functions, this->Limits);
      for (std::size_t i = first; i < last; ++i)
      {
        const CellPiece& piece = this->Pieces[static_cast<std::size_t>(owners[i].Piece)];
        const auto& ends = EdgeEnds[owners[i].Edge];
        const auto from = static_cast<std::size_t>(ends[0]);
        const auto to = static_cast<std::size_t>(ends[1]);
        const int parts = PartsOf(piece.Degree, this->LevelOf(edges.GetEdges()[i]) == 0);
        bent[i] = !test.IsEdgeStraight(piece.Cell, piece.Places[from], piece.Places[to],
          this->Samples[static_cast<std::size_t>(piece.Points[from])],
          this->Samples[static_cast<std::size_t>(piece.Points[to])], parts);
      }
    });
  for (std::size_t i = 0; i < owners.size(); ++i)
  {
    if (bent[i] != 0)
    {
      wishes.push_back({ edges.GetEdges()[i], owners[i], true });
    }
  }
}

//------------------------------------------------------------------------------
/** Longest edge between some corners of a piece; the first one in the order of edges of several. */
int CellDivision::Round::LongestEdge(const CellPiece& piece, const int* corners, int count) const
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
void CellDivision::Round::AddInside(ShapeTest& test, std::int32_t number, const int* corners,
  int count, std::vector<Wish>& wishes) const
{
  const CellPiece& piece = this->Pieces[static_cast<std::size_t>(number)];
  if (!test.IsMiddleStraight(piece, corners, count, this->Samples))
  {
    const int edge = this->LongestEdge(piece, corners, count);
    wishes.push_back({ EdgeOf(piece, edge), { number, edge }, true });
  }
}

//------------------------------------------------------------------------------
/** Tests the faces and the insides of new pieces of cells with a high degree. */
void CellDivision::Round::TestInside(std::vector<Wish>& wishes) const
{
  constexpr int corners[4] = { 0, 1, 2, 3 };
  std::vector<std::vector<Wish>> found(NumberOfBlocks(this->Pieces.size()));
  ForEachBlock(this->Pieces.size(), this->Loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      ShapeTest test(this->Fields, this->Functions, this->Limits);
      for (std::size_t p = first; p < last; ++p)
      {
        if (this->Pieces[p].Degree <= 2 || this->Pieces[p].NewEdges == 0)
        {
          continue;
        }
        const auto number = static_cast<std::int32_t>(p);
        for (const auto& face : PieceFaces)
        {
          this->AddInside(test, number, face.Corners, 3, found[block]);
        }
        this->AddInside(test, number, corners, 4, found[block]);
      }
    });
  for (const std::vector<Wish>& some : found)
  {
    wishes.insert(wishes.end(), some.begin(), some.end());
  }
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
void CellDivision::Round::AddLongEdges(std::vector<Wish>& wishes) const
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
  for (std::size_t p = 0; late.GetSize() > 0 && p < this->Pieces.size(); ++p)
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
        wishes.push_back({ EdgeOf(piece, edge), { static_cast<std::int32_t>(p), edge }, false });
      }
    }
  }
}

//------------------------------------------------------------------------------
bool CellDivision::Round::Mark()
{
  std::vector<Wish> wishes;
  this->TestEdges(wishes);
  this->TestInside(wishes);
  this->AddLongEdges(wishes);
  for (CellPiece& piece : this->Pieces)
  {
    piece.NewEdges = 0;
  }
  std::stable_sort(
    wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.Edge < b.Edge; });
  this->Marked = EdgeIndex(wishes.size());
  this->Owners.clear();
  this->Squares.clear();
  this->Touched.assign(this->Samples.size(), 0);
  for (std::size_t i = 0; i < wishes.size(); ++i)
  {
    const EdgePoints edge = wishes[i].Edge;
    if (i > 0 && wishes[i - 1].Edge == edge)
    {
      continue;
    }
    if (this->LevelOf(edge) >= this->Limits.MostLevels)
    {
      // The sort is stable, so the first wish for an edge is one beyond the limits, if there is
      // one.
      if (wishes[i].IsBeyond)
      {
        this->Unresolved.Add(edge);
      }
      continue;
    }
    this->Marked.Add(edge);
    this->Owners.push_back(wishes[i].Owner);
    this->Squares.push_back(this->SquareOf(edge));
    this->Touched[static_cast<std::size_t>(edge.First)] = 1;
    this->Touched[static_cast<std::size_t>(edge.Second)] = 1;
  }
  return this->Marked.GetSize() > 0;
}

//------------------------------------------------------------------------------
bool CellDivision::Round::HasRoom() const
{
  // Each marked edge halves one piece at least.
  const std::size_t count = this->Marked.GetSize();
  return static_cast<std::int64_t>(this->Pieces.size() + count) <= this->Limits.MostPieces &&
    this->Samples.size() + count <= std::numeric_limits<std::int32_t>::max();
}

//------------------------------------------------------------------------------
void CellDivision::Round::AddPoints()
{
  const std::size_t count = this->Marked.GetSize();
  const std::size_t first = this->Samples.size();
  this->Samples.resize(first + count);
  std::vector<WeightedPoints> rows(
    NumberOfBlocks(count), WeightedPoints(this->Fields.NumberOfPoints));
  ForEachBlock(count, this->Loop,
    [&](std::size_t block, std::size_t begin, std::size_t end)
    {
      CellSampler sampler(this->Fields, this->Functions);
      for (std::size_t i = begin; i < end; ++i)
      {
        const CellPiece& piece = this->Pieces[static_cast<std::size_t>(this->Owners[i].Piece)];
        const auto& ends = EdgeEnds[this->Owners[i].Edge];
        const PointWeights& row = sampler.Weigh(piece.Cell,
          0.5 *
            (glm::dvec3(piece.Places[static_cast<std::size_t>(ends[0])]) +
              glm::dvec3(piece.Places[static_cast<std::size_t>(ends[1])])));
        rows[block].Add(row);
        this->Samples[first + i] = SampleOf(this->Fields, row);
      }
    });
  for (const WeightedPoints& some : rows)
  {
    this->Points.Append(some);
  }
  for (const EdgePoints& edge : this->Marked.GetEdges())
  {
    this->Levels.push_back(static_cast<std::uint8_t>(this->LevelOf(edge) + 1));
  }
}

//------------------------------------------------------------------------------
/** Halves a piece, and its halves, at the longest marked edge until there is none. */
void CellDivision::Round::SplitPiece(const CellPiece& piece, std::vector<CellPiece>& parts) const
{
  std::int32_t longest = EdgeIndex::None;
  int cut = 0;
  for (int e = 0; e < 6; ++e)
  {
    const EdgePoints edge = EdgeOf(piece, e);
    // Points that this round has added are in no marked edge.
    const auto second = static_cast<std::size_t>(edge.Second);
    if (second >= this->Touched.size() || this->Touched[second] == 0 ||
      this->Touched[static_cast<std::size_t>(edge.First)] == 0)
    {
      continue;
    }
    const std::int32_t found = this->Marked.Find(edge);
    const auto squareOf = [this](std::int32_t i)
    { return this->Squares[static_cast<std::size_t>(i)]; };
    if (found != EdgeIndex::None &&
      (longest == EdgeIndex::None || squareOf(found) > squareOf(longest) ||
        (squareOf(found) == squareOf(longest) && found < longest)))
    {
      longest = found;
      cut = e;
    }
  }
  if (longest == EdgeIndex::None)
  {
    parts.push_back(piece);
    return;
  }
  const auto& ends = EdgeEnds[cut];
  const auto from = static_cast<std::size_t>(ends[0]);
  const auto to = static_cast<std::size_t>(ends[1]);
  const glm::vec3 middle = 0.5f * (piece.Places[from] + piece.Places[to]);
  const auto newPoint = static_cast<std::int32_t>(this->Touched.size()) + longest;
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
bool CellDivision::Round::Split()
{
  std::vector<std::vector<CellPiece>> parts(NumberOfBlocks(this->Pieces.size()));
  std::atomic<std::size_t> size(0);
  const auto most = static_cast<std::size_t>(this->Limits.MostPieces);
  ForEachBlock(this->Pieces.size(), this->Loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      // Blocks that come after the limit are not split, so as not to take more memory.
      for (std::size_t p = first; size.load(std::memory_order_relaxed) <= most && p < last; ++p)
      {
        const std::size_t before = parts[block].size();
        this->SplitPiece(this->Pieces[p], parts[block]);
        size.fetch_add(parts[block].size() - before, std::memory_order_relaxed);
      }
    });
  if (size > most)
  {
    return false;
  }
  this->Pieces.clear();
  this->Pieces.reserve(size);
  for (std::vector<CellPiece>& some : parts)
  {
    this->Pieces.insert(this->Pieces.end(), some.begin(), some.end());
    some = std::vector<CellPiece>();
  }
  return true;
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
  Round round(this->Pieces, fields, functions, limits, loop);
  // The first rounds take little time. Most divisions end within thirty.
  double rounds = 0.0;
  const auto goesOn = [&](double share)
  {
    rounds += share;
    return progress(1.0 - std::exp2(-rounds / 8.0));
  };
  while (round.Mark())
  {
    if (!round.HasRoom())
    {
      return DivisionStatus::TooLarge;
    }
    if (!goesOn(0.5))
    {
      return DivisionStatus::Aborted;
    }
    round.AddPoints();
    if (!goesOn(0.25))
    {
      return DivisionStatus::Aborted;
    }
    if (!round.Split())
    {
      return DivisionStatus::TooLarge;
    }
    if (!goesOn(0.25))
    {
      return DivisionStatus::Aborted;
    }
  }
  this->Points = std::move(round.GetPoints());
  this->Counts.Pieces = static_cast<std::int64_t>(this->Pieces.size());
  this->Counts.DividedEdges = this->Points.GetSize();
  this->Counts.UnresolvedEdges = round.GetNumberOfUnresolved();
  this->CountFolded(round.GetSamples(), limits.Place);
  this->KeepEdges();
  return DivisionStatus::Ok;
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
void CellDivision::KeepEdges()
{
  EdgeIndex edges(2 * this->Pieces.size());
  this->Edges.clear();
  for (const CellPiece& piece : this->Pieces)
  {
    for (int e = 0; piece.Degree > 0 && e < 6; ++e)
    {
      if (edges.Add(EdgeOf(piece, e)))
      {
        this->Edges.push_back({ { piece.Places[static_cast<std::size_t>(EdgeEnds[e][0])],
                                  piece.Places[static_cast<std::size_t>(EdgeEnds[e][1])] },
          piece.Cell });
      }
    }
  }
  this->Edges.shrink_to_fit();
}

//------------------------------------------------------------------------------
bool CellDivision::Holds(const PointFields& fields, const ShapeFunctionsMaker& functions,
  const DivisionLimits& limits, const RangeLoop& loop) const
{
  std::atomic<bool> holds(true);
  ForEachBlock(this->Edges.size(), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      ShapeTest test(fields, functions, limits);
      for (std::size_t i = first; i < last && holds.load(std::memory_order_relaxed); ++i)
      {
        const TestedEdge& edge = this->Edges[i];
        if (!test.IsEdgeStraight(edge.Cell, edge.Places[0], edge.Places[1], PartsOf(0, false)))
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
