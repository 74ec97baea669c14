// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/SeamClosure.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace meniscus
{
namespace
{

// Two chains each deviate from the true image by one tolerance, by a little more between the tested
// places, and a mapped one may have been moved by two.
constexpr double Widest = 4.0;

// Number of seams that a thread closes at once: tens of microseconds of work.
constexpr std::size_t SeamsPerBlock = 32;

auto GetKey(const ImagePoint& point)
{
  const glm::dvec3& p = point.Vertex.Position;
  return std::make_tuple(p.x, p.y, p.z);
}

bool AreSame(const ImagePoint& a, const ImagePoint& b)
{
  return a.Vertex.Position == b.Vertex.Position;
}

// The side of the object that both points come from; returns false if there is none.
bool FindCommonSide(const ImagePoint& a, const ImagePoint& b, Seam& seam)
{
  const std::size_t count = a.GetNumberOfSources();
  const std::size_t other = b.GetNumberOfSources();
  if (count > 2 || other > 2)
  {
    return false;
  }
  const ImagePoint& larger = count == 2 ? a : b;
  const ImagePoint& smaller = count == 2 ? b : a;
  const std::int64_t first = larger.Source[0];
  const std::int64_t last = larger.GetNumberOfSources() == 2 ? larger.Source[1] : smaller.Source[0];
  const auto isEnd = [first, last](std::int64_t id) { return id == first || id == last; };
  seam = { std::min(first, last), std::max(first, last), 0 };
  return first != last && isEnd(smaller.Source[0]) &&
    (smaller.GetNumberOfSources() != 2 || isEnd(smaller.Source[1]));
}

// Parameter of a point on a seam, from 0 at the end with the lower index.
double GetPlace(const ImagePoint& point, std::int64_t high)
{
  for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
  {
    if (point.Source[k] == high)
    {
      return point.Weight[k];
    }
  }
  return 0.0;
}

using Loop = std::vector<const ImagePoint*>;

const ImagePoint* FindFarthest(const Loop& loop, const ImagePoint& from)
{
  return *std::max_element(loop.begin(), loop.end(),
    [&from](const ImagePoint* a, const ImagePoint* b)
    {
      const glm::dvec3 first = a->Vertex.Position - from.Vertex.Position;
      const glm::dvec3 second = b->Vertex.Position - from.Vertex.Position;
      return glm::dot(first, first) < glm::dot(second, second);
    });
}

// Both ways round the loop, from its lowest place on the seam to its highest; empty if the
// parameter decreases along either.
std::pair<Loop, Loop> FindWays(const Loop& loop, std::int64_t high)
{
  const auto isBefore = [high](const ImagePoint* a, const ImagePoint* b)
  { return GetPlace(*a, high) < GetPlace(*b, high); };
  const auto ends = std::minmax_element(loop.begin(), loop.end(), isBefore);
  const auto low = static_cast<std::size_t>(ends.first - loop.begin());
  const auto top = static_cast<std::size_t>(ends.second - loop.begin());
  const std::size_t count = loop.size();
  std::pair<Loop, Loop> ways;
  for (std::size_t i = low;; i = (i + 1) % count)
  {
    ways.first.push_back(loop[i]);
    if (i == top)
    {
      break;
    }
  }
  for (std::size_t i = low;; i = (i + count - 1) % count)
  {
    ways.second.push_back(loop[i]);
    if (i == top)
    {
      break;
    }
  }
  return std::is_sorted(ways.first.begin(), ways.first.end(), isBefore) &&
      std::is_sorted(ways.second.begin(), ways.second.end(), isBefore)
    ? ways
    : std::pair<Loop, Loop>();
}

}

//------------------------------------------------------------------------------
std::vector<Seam> FindSeams(
  const ObjectCells& cells, std::size_t count, const unsigned char* isMapped)
{
  std::vector<Seam> seams;
  VisitPolygonSides(
    cells, count, [isMapped](std::size_t cell) { return isMapped[cell] != 0; },
    [&seams](const Seam& side) { seams.push_back(side); });
  std::sort(seams.begin(), seams.end());
  seams.erase(std::unique(seams.begin(), seams.end(),
                [](const Seam& a, const Seam& b) { return a.Low == b.Low && a.High == b.High; }),
    seams.end());
  if (!seams.empty())
  {
    VisitPolygonSides(
      cells, count, [](std::size_t) { return true; },
      [&seams](const Seam& side)
      {
        const std::ptrdiff_t at = FindSeam(seams, side);
        if (at >= 0)
        {
          ++seams[static_cast<std::size_t>(at)].Cells;
        }
      });
  }
  return seams;
}

//------------------------------------------------------------------------------
SeamClosure::SeamClosure(
  const std::vector<Seam>& seams, bool hasDiagonals, const glm::dvec3& eye, double tolerance)
  : Seams(seams)
  , HasDiagonals(hasDiagonals)
  , Eye(eye)
  , Tolerance(tolerance)
{
  for (const Seam& seam : seams)
  {
    const auto size = static_cast<std::size_t>(seam.High) + 1;
    this->HasSeam.resize(std::max(this->HasSeam.size(), size), 0);
    this->HasSeam[static_cast<std::size_t>(seam.Low)] = 1;
    this->HasSeam[static_cast<std::size_t>(seam.High)] = 1;
  }
}

//------------------------------------------------------------------------------
void SeamClosure::Collect(
  const ImageMesh& mesh, const std::vector<ImagePoint>& points, bool areWhole)
{
  // Most points are on no seam, and their cells need not read them.
  std::vector<char> mayBeOnSeam(points.size());
  std::transform(points.begin(), points.end(), mayBeOnSeam.begin(),
    [this](const ImagePoint& point) { return this->MayBeOnSeam(point) ? 1 : 0; });
  std::int64_t begin = 0;
  for (std::size_t cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const std::int64_t end = mesh.Ends[cell];
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto at = [&mesh](std::int64_t k)
      { return static_cast<std::size_t>(mesh.Connectivity[static_cast<std::size_t>(k)]); };
      const std::size_t a = at(i);
      const std::size_t b = at(i + 1 < end ? i + 1 : begin);
      if (mayBeOnSeam[a] && mayBeOnSeam[b])
      {
        this->AddPart(mesh, cell, points[a], points[b], areWhole);
      }
    }
    begin = end;
  }
}

//------------------------------------------------------------------------------
// True if the point comes from one or two points of the object, at all of which there are seams.
// The ends of a diagonal are such points, too: corners of a mapped polygon.
bool SeamClosure::MayBeOnSeam(const ImagePoint& point) const
{
  const std::size_t count = point.GetNumberOfSources();
  return count <= 2 &&
    std::all_of(point.Source.begin(), point.Source.begin() + count,
      [this](std::int64_t id)
      {
        const auto i = static_cast<std::size_t>(id);
        return i < this->HasSeam.size() && this->HasSeam[i];
      });
}

//------------------------------------------------------------------------------
// Records a side of a cell if both of its ends come from one side of the object.
void SeamClosure::AddPart(
  const ImageMesh& mesh, std::size_t cell, const ImagePoint& a, const ImagePoint& b, bool isWhole)
{
  Seam seam;
  if (!FindCommonSide(a, b, seam))
  {
    return;
  }
  const std::ptrdiff_t known = FindSeam(this->Seams, seam);
  if (!AreSame(a, b) &&
    (known >= 0 ? this->Seams[static_cast<std::size_t>(known)].Cells > 1 : this->HasDiagonals))
  {
    this->All.push_back(
      { seam.Low, seam.High, a, b, mesh.SourceCells[cell], mesh.Orientations[cell], isWhole });
  }
}

//------------------------------------------------------------------------------
void SeamClosure::Close(ImageMesh& mesh, const RangeLoop& loop)
{
  Parts order;
  order.reserve(this->All.size());
  for (const Part& part : this->All)
  {
    order.push_back(&part);
  }
  const auto isBefore = [](const Part* a, const Part* b)
  { return std::tie(a->Low, a->High) < std::tie(b->Low, b->High); };
  std::stable_sort(order.begin(), order.end(), isBefore);
  std::vector<Parts::iterator> firsts; // of each seam
  for (auto begin = order.begin(); begin != order.end();)
  {
    firsts.push_back(begin);
    begin = std::upper_bound(begin, order.end(), *begin, isBefore);
  }
  const std::size_t count = firsts.size();
  firsts.push_back(order.end());
  std::vector<Closed> blocks((count + SeamsPerBlock - 1) / SeamsPerBlock);
  loop(blocks.size(),
    [this, &firsts, &blocks, count](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin * SeamsPerBlock; i < std::min(end * SeamsPerBlock, count); ++i)
      {
        Closed& block = blocks[i / SeamsPerBlock];
        this->CloseSeam({ firsts[i], firsts[i + 1] }, block.Open, block.Mesh);
      }
    });
  Parts open;
  for (const Closed& block : blocks)
  {
    open.insert(open.end(), block.Open.begin(), block.Open.end());
    mesh.Append(block.Mesh);
  }
  const std::vector<Part> sides = this->FindFreeSides(open, mesh);
  for (const Part& side : sides)
  {
    open.push_back(&side);
  }
  this->CloseAcrossSeams(open, mesh);
}

//------------------------------------------------------------------------------
// Where more than two cells share the seam, each of them is joined to the first, and parts that
// stay open are ambiguous.
void SeamClosure::CloseSeam(Parts parts, Parts& open, ImageMesh& mesh) const
{
  const Seam seam{ parts.front()->Low, parts.front()->High, 0 };
  const std::ptrdiff_t known = FindSeam(this->Seams, seam);
  if (known < 0 || this->Seams[static_cast<std::size_t>(known)].Cells == 2)
  {
    this->CloseLoops(std::move(parts), open, mesh);
    return;
  }
  std::stable_sort(
    parts.begin(), parts.end(), [](const Part* a, const Part* b) { return a->Cell < b->Cell; });
  const auto findEnd = [&parts](Parts::iterator begin)
  {
    return std::find_if(
      begin, parts.end(), [begin](const Part* part) { return part->Cell != (*begin)->Cell; });
  };
  const auto firstEnd = findEnd(parts.begin());
  for (auto begin = firstEnd; begin != parts.end();)
  {
    const auto end = findEnd(begin);
    Parts both(parts.begin(), firstEnd);
    both.insert(both.end(), begin, end);
    Parts ambiguous;
    this->CloseLoops(std::move(both), ambiguous, mesh);
    begin = end;
  }
}

//------------------------------------------------------------------------------
void SeamClosure::CloseLoops(Parts parts, Parts& open, ImageMesh& mesh) const
{
  const auto getKeys = [](const Part* part)
  {
    const auto from = GetKey(part->From);
    const auto to = GetKey(part->To);
    return from < to ? std::make_pair(from, to) : std::make_pair(to, from);
  };
  std::stable_sort(parts.begin(), parts.end(),
    [&getKeys](const Part* a, const Part* b) { return getKeys(a) < getKeys(b); });
  Parts left;
  for (const Part* part : parts)
  {
    if (!left.empty() && getKeys(left.back()) == getKeys(part))
    {
      left.pop_back();
    }
    else
    {
      left.push_back(part);
    }
  }
  // A loop starts with any part, reversed, and continues with any part that begins where the last
  // one ended, until it returns to its start.
  while (!left.empty())
  {
    const Part& first = *left.back();
    left.pop_back();
    Loop loop = { &first.To, &first.From };
    Parts used = { &first };
    while (!AreSame(*loop.back(), *loop.front()))
    {
      const ImagePoint& last = *loop.back();
      const auto next = std::find_if(left.begin(), left.end(),
        [&last](const Part* part) { return AreSame(part->From, last) || AreSame(part->To, last); });
      if (next == left.end())
      {
        // The chain ends at a border of the membrane or of a region of total reflection, or at
        // another seam.
        open.insert(open.end(), used.begin(), used.end());
        break;
      }
      used.push_back(*next);
      loop.push_back(AreSame((*next)->From, last) ? &(*next)->To : &(*next)->From);
      left.erase(next);
    }
    if (loop.size() > 3 && AreSame(*loop.back(), *loop.front()))
    {
      loop.pop_back();
      this->Fill(loop, first, mesh);
    }
  }
}

//------------------------------------------------------------------------------
std::vector<SeamClosure::Part> SeamClosure::FindFreeSides(
  const Parts& open, const ImageMesh& mesh) const
{
  std::set<std::pair<std::int64_t, std::int64_t>> openSeams;
  for (const Part* part : open)
  {
    openSeams.insert({ part->Low, part->High });
  }
  std::set<std::int64_t> polygons;
  for (const Part& part : this->All)
  {
    if (!part.IsWhole && openSeams.count({ part.Low, part.High }) > 0)
    {
      polygons.insert(part.Cell);
    }
  }
  using Key = decltype(GetKey(std::declval<ImagePoint>()));
  std::map<std::tuple<std::int64_t, Key, Key>, Part> free;
  std::int64_t begin = 0;
  bool isWanted = false;
  for (std::size_t cell = 0; cell < mesh.GetNumberOfCells() && !polygons.empty(); ++cell)
  {
    const std::int64_t end = mesh.Ends[cell];
    const bool isNext = cell == 0 || mesh.SourceCells[cell] != mesh.SourceCells[cell - 1];
    isWanted = isNext ? polygons.count(mesh.SourceCells[cell]) > 0 : isWanted;
    for (std::int64_t i = begin; i < end && isWanted; ++i)
    {
      const auto at = [&mesh](std::int64_t k) -> const ImagePoint& {
        return mesh
          .Points[static_cast<std::size_t>(mesh.Connectivity[static_cast<std::size_t>(k)])];
      };
      const ImagePoint& a = at(i);
      const ImagePoint& b = at(i + 1 < end ? i + 1 : begin);
      Seam seam;
      if (AreSame(a, b) || FindCommonSide(a, b, seam))
      {
        continue;
      }
      // The list makes copies; references to the two keys would outlive them.
      const auto [first, last] = std::minmax({ GetKey(a), GetKey(b) });
      const auto [known, isNew] = free.insert({ { mesh.SourceCells[cell], first, last },
        { -1, -1, a, b, mesh.SourceCells[cell], mesh.Orientations[cell], false } });
      if (!isNew)
      {
        free.erase(known);
      }
    }
    begin = end;
  }
  std::vector<Part> sides;
  for (const auto& side : free)
  {
    sides.push_back(side.second);
  }
  return sides;
}

//------------------------------------------------------------------------------
// Walks along parts that are not used yet, at each end to the first one in the order of `open`.
void SeamClosure::CloseAcrossSeams(const Parts& open, ImageMesh& mesh) const
{
  using Key = decltype(GetKey(std::declval<ImagePoint>()));
  std::vector<std::pair<Key, std::size_t>> ends;
  for (std::size_t i = 0; i < open.size(); ++i)
  {
    ends.emplace_back(GetKey(open[i]->From), i);
    ends.emplace_back(GetKey(open[i]->To), i);
  }
  std::sort(ends.begin(), ends.end());
  std::vector<char> isUsed(open.size(), 0);
  for (std::size_t i = 0; i < open.size(); ++i)
  {
    if (isUsed[i])
    {
      continue;
    }
    isUsed[i] = 1;
    Loop loop = { &open[i]->To, &open[i]->From };
    while (!AreSame(*loop.back(), *loop.front()))
    {
      const auto key = GetKey(*loop.back());
      auto next = std::lower_bound(ends.begin(), ends.end(), std::make_pair(key, std::size_t(0)));
      while (next != ends.end() && next->first == key && isUsed[next->second])
      {
        ++next;
      }
      if (next == ends.end() || next->first != key)
      {
        break; // a border
      }
      isUsed[next->second] = 1;
      const Part& part = *open[next->second];
      loop.push_back(AreSame(part.From, *loop.back()) ? &part.To : &part.From);
    }
    if (loop.size() > 3 && AreSame(*loop.back(), *loop.front()))
    {
      loop.pop_back();
      if (this->IsThin(loop))
      {
        AddCell(loop, *open[i], mesh);
      }
    }
  }
}

//------------------------------------------------------------------------------
// True if the loop is within a few tolerances of a straight line.
bool SeamClosure::IsThin(const Loop& loop) const
{
  const glm::dvec3 begin = FindFarthest(loop, *loop.front())->Vertex.Position;
  const glm::dvec3 end = FindFarthest(loop, *FindFarthest(loop, *loop.front()))->Vertex.Position;
  const glm::dvec3 across = glm::cross(begin - this->Eye, end - this->Eye);
  const double width = Widest * this->Tolerance * glm::length(across);
  return std::all_of(loop.begin(), loop.end(),
    [this, &across, width](const ImagePoint* point)
    {
      const glm::dvec3 way = point->Vertex.Position - this->Eye;
      return std::fabs(glm::dot(across, way)) <= width * glm::length(way);
    });
}

//------------------------------------------------------------------------------
void SeamClosure::AddCell(const Loop& loop, const Part& first, ImageMesh& mesh)
{
  for (const ImagePoint* point : loop)
  {
    mesh.Connectivity.push_back(static_cast<std::int64_t>(mesh.Points.size()));
    mesh.Points.push_back(*point);
  }
  mesh.EndCell(first.Cell, first.Orientation);
}

//------------------------------------------------------------------------------
// A polygon that is drawn unchanged may lack an image that its neighbour has, which leaves no gap
// to fill. But a chain along which the parameter grows from one end of the seam to the other shows
// each place once: it is the image that the polygon draws, however far it is from it.
void SeamClosure::Fill(const Loop& loop, const Part& first, ImageMesh& mesh) const
{
  if (loop.size() == 3 || this->IsThin(loop))
  {
    AddCell(loop, first, mesh);
    return;
  }
  // Triangles between the two chains, for a curved seam.
  const auto [forward, backward] = FindWays(loop, first.High);
  std::size_t i = 0;
  std::size_t j = 0;
  while (i + 1 < forward.size() || j + 1 < backward.size())
  {
    const bool isForward = j + 1 == backward.size() ||
      (i + 1 < forward.size() &&
        GetPlace(*forward[i + 1], first.High) < GetPlace(*backward[j + 1], first.High));
    const Loop triangle = { forward[i], isForward ? forward[i + 1] : backward[j + 1], backward[j] };
    (isForward ? i : j) += 1;
    if (triangle[0] != triangle[2] && triangle[1] != triangle[0] && triangle[1] != triangle[2])
    {
      AddCell(triangle, first, mesh);
    }
  }
}

}
