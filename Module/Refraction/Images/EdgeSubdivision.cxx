// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/EdgeSubdivision.h"

#include "Common/PointOrder.h"
#include "Refraction/Images/ImageTurns.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <utility>

namespace meniscus
{
namespace
{

// Shortest part of an edge: 2^-14 of the primitive's edge. It is reached where the virtual geometry
// has a corner, at a crease of the membrane; there the error shrinks with the length.
constexpr int DeepestLevel = 14;

// Enough for the edges of a few dozen cells.
constexpr std::size_t CacheSize = 1024;

// The table is doubled when it is half full.
constexpr std::size_t SmallestEdgeTable = 64;

// Parts of a triangle whose sides are solved together: few enough that their middles do not replace
// each other in the cache.
constexpr std::size_t PartsAtOnce = 64;

// Middles of edges that are not divided, and of those that are not tested yet.
constexpr std::int32_t NotSplit = -1;
constexpr std::int32_t NotTested = -2;

// Error of an edge of half the length, where the bend is the same.
constexpr double OfHalf = 0.25;

std::size_t Hash(const glm::dvec3& point)
{
  std::uint64_t bits[3];
  std::memcpy(bits, &point.x, sizeof(bits));
  // Multipliers of a well mixed linear congruential generator, one for each coordinate.
  std::uint64_t sum =
    bits[0] * 0x9e3779b97f4a7c15u + bits[1] * 0xbf58476d1ce4e5b9u + bits[2] * 0x94d049bb133111ebu;
  sum ^= sum >> 32;
  return static_cast<std::size_t>(sum * 0x9e3779b97f4a7c15u >> 32);
}

}

//------------------------------------------------------------------------------
EdgeSubdivision::EdgeSubdivision(const CurvedMembraneSolver& geometry, double tolerance)
  : Geometry(geometry)
  , Tolerance(tolerance)
  , Eye(geometry.GetMedia().Eye + geometry.GetMembrane().GetOrigin())
  , Cache(std::move(GetSpareCache()))
  , Edges(SmallestEdgeTable, Edge{ 0, NotSplit, 0 })
{
  static std::atomic<std::uint64_t> last{ 0 };
  this->Number = ++last;
  this->Cache.resize(CacheSize);
}

//------------------------------------------------------------------------------
EdgeSubdivision::~EdgeSubdivision()
{
  GetSpareCache() = std::move(this->Cache);
}

//------------------------------------------------------------------------------
std::vector<EdgeSubdivision::Middle>& EdgeSubdivision::GetSpareCache()
{
  thread_local std::vector<Middle> spare;
  return spare;
}

//------------------------------------------------------------------------------
EdgeSubdivision::Middle& EdgeSubdivision::FindEntry(const glm::dvec3& point)
{
  return this->Cache[Hash(point) % CacheSize];
}

//------------------------------------------------------------------------------
// Searches for an image that is many facets from the sight points of the ends, where Newton's
// method loses it. A point with several images gets none.
void EdgeSubdivision::SearchIfLost(const glm::dvec3& point, VirtualVertex& image)
{
  if (image.State == ImageState::Found)
  {
    return;
  }
  this->Geometry.FindImages(point, this->Searched);
  if (this->Searched.size() == 1)
  {
    image = this->Searched.front();
  }
}

//------------------------------------------------------------------------------
const VirtualVertex& EdgeSubdivision::FindMiddle(const Stretch& part)
{
  const glm::dvec3 point = part.GetMiddle();
  Middle& middle = this->FindEntry(point);
  if (!this->IsStored(middle, point))
  {
    middle.Owner = this->Number;
    middle.Point = point;
    middle.Vertex = this->Geometry.SolveBetween(point, *part.Image[0], *part.Image[1]);
    this->SearchIfLost(point, middle.Vertex);
  }
  return middle.Vertex;
}

//------------------------------------------------------------------------------
// Solves the middles of `Tested` that are not stored, side by side.
void EdgeSubdivision::PrepareMiddles()
{
  std::array<CurvedMembraneSolver::PointBetween, CurvedMembraneSolver::MostBetween> open{};
  std::size_t size = 0;
  ++this->Batch;
  const auto solve = [this, &open, &size]()
  {
    this->Geometry.SolveAllBetween(open.data(), size);
    ++this->Batch;
    for (std::size_t i = 0; i < size; ++i)
    {
      this->SearchIfLost(open[i].Point, *open[i].Image);
    }
    size = 0;
  };
  for (const Stretch& part : this->Tested)
  {
    const glm::dvec3 point = part.GetMiddle();
    Middle& middle = this->FindEntry(point);
    if (this->IsStored(middle, point))
    {
      continue;
    }
    const bool isTaken = middle.Owner == this->Number && middle.Batch == this->Batch;
    if (isTaken || size == open.size())
    {
      solve();
    }
    middle.Owner = this->Number;
    middle.Batch = this->Batch;
    middle.Point = point;
    open[size++] = { point, part.Image[0], part.Image[1], &middle.Vertex };
  }
  solve();
}

//------------------------------------------------------------------------------
// The ends get an order that depends on them alone, so that both neighbours solve the same middles.
void EdgeSubdivision::AddTested(const ImagedPoint& from, const ImagedPoint& to)
{
  const bool isTurned = IsBefore(to.Point, from.Point);
  const ImagedPoint& a = isTurned ? to : from;
  const ImagedPoint& b = isTurned ? from : to;
  this->Tested.push_back({ this->Tested.size(), { a.Point, b.Point },
    { a.Image->Position, b.Image->Position }, { a.Image, b.Image } });
}

//------------------------------------------------------------------------------
// Finds the shapes of the edges `Tested`, whose points are solved side by side.
void EdgeSubdivision::JudgeSides()
{
  this->Sides.assign(this->Tested.size(), Side());
  this->TestedImages.clear();
  for (int depth = 0; !this->Tested.empty(); ++depth)
  {
    this->PrepareMiddles();
    this->NextTested.clear();
    for (const Stretch& part : this->Tested)
    {
      Side& side = this->Sides[part.Side];
      if (side.Form != Shape::Straight)
      {
        continue; // another part has decided it
      }
      const VirtualVertex& middle = this->FindMiddle(part);
      const glm::dvec3 error = this->GetError(0.5 * (part.Drawn[0] + part.Drawn[1]), middle);
      if (depth == 0)
      {
        side.Middle = middle;
        side.Error = error;
      }
      const Shape shape = this->JudgeMiddle(part, middle, error, depth);
      if (shape != Shape::Undecided)
      {
        side.Form = shape;
        continue;
      }
      this->TestedImages.push_back(middle); // its entry may be overwritten
      const std::array<Stretch, 2> halves = Halve(part, this->TestedImages.back());
      this->NextTested.insert(this->NextTested.end(), halves.begin(), halves.end());
    }
    this->Tested.swap(this->NextTested);
  }
}

//------------------------------------------------------------------------------
std::vector<bool> EdgeSubdivision::AreStraight(const std::vector<std::array<ImagedPoint, 2>>& edges)
{
  this->Tested.clear();
  for (const std::array<ImagedPoint, 2>& edge : edges)
  {
    this->AddTested(edge[0], edge[1]);
  }
  this->JudgeSides();
  std::vector<bool> result(edges.size());
  std::transform(this->Sides.begin(), this->Sides.end(), result.begin(),
    [](const Side& side) { return side.Form == Shape::Straight; });
  return result;
}

//------------------------------------------------------------------------------
// Angle between a drawn place and an image, seen from the eye, in tolerances.
glm::dvec3 EdgeSubdivision::GetError(const glm::dvec3& drawn, const VirtualVertex& image) const
{
  return (glm::normalize(image.Position - this->Eye) - glm::normalize(drawn - this->Eye)) /
    this->Tolerance;
}

//------------------------------------------------------------------------------
// True if an edge of the facet is at least that long.
bool EdgeSubdivision::HasEdge(std::int32_t facet, double squaredLength) const
{
  const Membrane& membrane = this->Geometry.GetMembrane();
  const Membrane::Facet& f = membrane.GetFacets()[static_cast<std::size_t>(facet)];
  const auto isLong = [&membrane, &f, squaredLength](std::size_t i, std::size_t j)
  {
    const glm::dvec3 edge = membrane.GetPositions()[static_cast<std::size_t>(f[i])] -
      membrane.GetPositions()[static_cast<std::size_t>(f[j])];
    return glm::dot(edge, edge) >= squaredLength;
  };
  return isLong(0, 1) || isLong(1, 2) || isLong(2, 0);
}

//------------------------------------------------------------------------------
// True if the sight points are no farther apart than the membrane's vertices there.
bool EdgeSubdivision::AreNeighbours(const VirtualVertex& a, const VirtualVertex& b) const
{
  const glm::dvec3 way = a.SightPoint - b.SightPoint;
  const double squared = glm::dot(way, way);
  return a.Facet == b.Facet || (this->HasEdge(a.Facet, squared) && this->HasEdge(b.Facet, squared));
}

//------------------------------------------------------------------------------
// True if the image of a line may be S-shaped between two points. Their directions are no farther
// apart than their distance over that of the nearer one from the eye, which settles most cases.
bool EdgeSubdivision::MayTurn(const VirtualVertex& a, const VirtualVertex& b) const
{
  const glm::dvec3 first = a.Position - this->Eye;
  const glm::dvec3 last = b.Position - this->Eye;
  const glm::dvec3 way = last - first;
  const double nearest = std::min(glm::dot(first, first), glm::dot(last, last));
  return MayTurnTwice(std::sqrt(glm::dot(way, way) / nearest), this->Tolerance) &&
    MayTurnTwice(glm::length(glm::normalize(first) - glm::normalize(last)), this->Tolerance);
}

//------------------------------------------------------------------------------
// True if there are no waves of the membrane between two points, and no S-shape.
bool EdgeSubdivision::AreSampled(const VirtualVertex& a, const VirtualVertex& b) const
{
  return this->AreNeighbours(a, b) && !this->MayTurn(a, b);
}

//------------------------------------------------------------------------------
// True if the error is about the expected one. An edge whose middle is on its chord is divided
// because of waves between.
bool EdgeSubdivision::Follows(const Side& side, const glm::dvec3& expected)
{
  const double error = glm::length(side.Error);
  return error > 1.0 && glm::length(side.Error - expected) <= MostChange * error;
}

//------------------------------------------------------------------------------
// True if the halves of an edge that is divided need no test.
bool EdgeSubdivision::AreHalvesSmooth(
  const VirtualVertex& a, const Side& side, const VirtualVertex& b, bool follows) const
{
  const double error = glm::length(side.Error);
  return error > 1.0 && error <= (follows ? FollowedParts : TestedParts) &&
    this->AreSampled(a, side.Middle) && this->AreSampled(side.Middle, b);
}

//------------------------------------------------------------------------------
std::array<EdgeSubdivision::Stretch, 2> EdgeSubdivision::Halve(
  const Stretch& part, const VirtualVertex& middle)
{
  const glm::dvec3 point = part.GetMiddle();
  const glm::dvec3 drawn = 0.5 * (part.Drawn[0] + part.Drawn[1]);
  return {
    { { part.Side, { part.Point[0], point }, { part.Drawn[0], drawn }, { part.Image[0], &middle } },
      { part.Side, { point, part.Point[1] }, { drawn, part.Drawn[1] },
        { &middle, part.Image[1] } } }
  };
}

//------------------------------------------------------------------------------
// The shape of a part of an edge, as far as its middle and the middle's error tell it.
EdgeSubdivision::Shape EdgeSubdivision::JudgeMiddle(
  const Stretch& part, const VirtualVertex& middle, const glm::dvec3& error, int depth) const
{
  if (middle.State != ImageState::Found)
  {
    return Shape::Open;
  }
  if (!(glm::dot(error, error) <= 1.0))
  {
    return Shape::Bent;
  }
  const bool isSampled = this->AreNeighbours(*part.Image[0], middle) &&
    this->AreNeighbours(middle, *part.Image[1]) && !this->MayTurn(*part.Image[0], *part.Image[1]);
  return depth == DeepestLevel || isSampled ? Shape::Straight : Shape::Undecided;
}

//------------------------------------------------------------------------------
void EdgeSubdivision::MoveOntoEdge(
  const ImagedPoint& a, const ImagedPoint& b, double l, VirtualVertex& image)
{
  glm::dvec3 point[2] = { a.Point, b.Point };
  VirtualVertex end[2] = { *a.Image, *b.Image };
  glm::dvec3 expected(0.0);
  bool isStraight = false;
  for (int depth = 0; depth <= DeepestLevel; ++depth)
  {
    isStraight = isStraight || depth == DeepestLevel;
    if (!isStraight)
    {
      this->Tested.clear();
      this->AddTested({ -1, point[0], &end[0] }, { -1, point[1], &end[1] });
      this->JudgeSides();
    }
    const Shape shape = isStraight ? Shape::Straight : this->Sides[0].Form;
    if (shape == Shape::Open)
    {
      return;
    }
    if (shape == Shape::Straight)
    {
      // Between the tested places the edge deviates little more than at them.
      constexpr double sameBranch = 2.0;
      const glm::dvec3 drawn = (1.0 - l) * end[0].Position + l * end[1].Position;
      image.Position =
        glm::length(this->GetError(drawn, image)) <= sameBranch ? drawn : image.Position;
      return;
    }
    const Side& side = this->Sides[0];
    isStraight = this->AreHalvesSmooth(end[0], side, end[1], Follows(side, expected));
    expected = OfHalf * side.Error;
    const int half = l < 0.5 ? 0 : 1;
    point[1 - half] = 0.5 * (point[0] + point[1]);
    end[1 - half] = side.Middle;
    l = 2.0 * l - half;
  }
}

//------------------------------------------------------------------------------
void EdgeSubdivision::Start(const std::array<ImagedPoint, 3>& corners, std::size_t count)
{
  this->Failed = false;
  this->IsFull = false;
  this->Nodes.clear();
  this->EdgeCount = 0;
  ++this->Round; // empties the table without clearing it
  for (std::size_t k = 0; k < count; ++k)
  {
    glm::dvec3 weight(0.0);
    weight[static_cast<glm::length_t>(k)] = 1.0;
    this->Nodes.push_back({ weight, corners[k].Point, *corners[k].Image });
  }
}

//------------------------------------------------------------------------------
std::uint64_t EdgeSubdivision::MakeKey(std::int32_t a, std::int32_t b)
{
  const auto low = static_cast<std::uint64_t>(std::min(a, b));
  const auto high = static_cast<std::uint64_t>(std::max(a, b));
  return low << 32 | high;
}

//------------------------------------------------------------------------------
// The edge's entry in the table, or a free entry for it.
EdgeSubdivision::Edge& EdgeSubdivision::FindEdge(std::uint64_t key)
{
  const std::size_t mask = this->Edges.size() - 1;
  std::size_t at = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15u >> 32) & mask;
  while (this->Edges[at].Round == this->Round && this->Edges[at].Key != key)
  {
    at = (at + 1) & mask;
  }
  return this->Edges[at];
}

//------------------------------------------------------------------------------
// The edge's entry, which is added with an error that is expected if it is new. It may move when
// the next one is added.
EdgeSubdivision::Edge& EdgeSubdivision::AddUntested(
  std::int32_t a, std::int32_t b, const glm::dvec3& error, bool isStraight)
{
  const std::uint64_t key = MakeKey(a, b);
  Edge& edge = this->FindEdge(key);
  if (edge.Round == this->Round)
  {
    return edge;
  }
  edge = { key, isStraight ? NotSplit : NotTested, this->Round, isStraight, isStraight, error };
  if (2 * ++this->EdgeCount <= this->Edges.size())
  {
    return edge;
  }
  this->GrowEdges();
  return this->FindEdge(key);
}

//------------------------------------------------------------------------------
void EdgeSubdivision::GrowEdges()
{
  std::vector<Edge> before(2 * this->Edges.size(), Edge{ 0, NotSplit, this->Round - 1 });
  before.swap(this->Edges);
  for (const Edge& edge : before)
  {
    if (edge.Round == this->Round)
    {
      this->FindEdge(edge.Key) = edge;
    }
  }
}

//------------------------------------------------------------------------------
// An edge; if it has not been tested, with no middle.
EdgeSubdivision::Edge EdgeSubdivision::GetEdge(std::int32_t a, std::int32_t b)
{
  Edge edge = this->FindEdge(MakeKey(a, b));
  edge.Middle = edge.Round == this->Round && edge.Middle >= 0 ? edge.Middle : NotSplit;
  return edge;
}

//------------------------------------------------------------------------------
// Adds an edge to those that are tested next, unless it is known or among them.
void EdgeSubdivision::TestEdge(std::int32_t a, std::int32_t b)
{
  Edge& edge = this->AddUntested(a, b, glm::dvec3(0.0), false);
  if (edge.Middle == NotTested)
  {
    edge.Middle = NotSplit;
    const Node& first = this->Nodes[static_cast<std::size_t>(a)];
    const Node& last = this->Nodes[static_cast<std::size_t>(b)];
    this->TestedKeys.push_back(edge.Key);
    this->AddTested({ -1, first.Point, &first.Vertex }, { -1, last.Point, &last.Vertex });
  }
}

//------------------------------------------------------------------------------
// Tests the edges that have been chosen, and adds the nodes in the middles of bent ones.
void EdgeSubdivision::SettleEdges()
{
  this->JudgeSides();
  for (std::size_t i = 0; i < this->TestedKeys.size(); ++i)
  {
    this->SettleEdge(this->TestedKeys[i], this->Sides[i]);
  }
  this->TestedKeys.clear();
}

//------------------------------------------------------------------------------
void EdgeSubdivision::SettleEdge(std::uint64_t key, const Side& side)
{
  Edge& edge = this->FindEdge(key);
  this->Failed = this->Failed || side.Form == Shape::Open;
  this->IsFull = this->IsFull || (side.Form == Shape::Bent && this->Nodes.size() >= MostNodes);
  edge.IsSmooth = side.Form == Shape::Straight;
  edge.Follows = Follows(side, edge.Error);
  edge.Error = side.Error;
  if (side.Form != Shape::Bent || this->IsFull)
  {
    return;
  }
  const auto a = static_cast<std::int32_t>(key >> 32);
  const auto b = static_cast<std::int32_t>(key & 0xffffffffu);
  const Node& first = this->Nodes[static_cast<std::size_t>(a)];
  const Node& second = this->Nodes[static_cast<std::size_t>(b)];
  edge.Middle = static_cast<std::int32_t>(this->Nodes.size());
  edge.IsSmooth = this->AreHalvesSmooth(first.Vertex, side, second.Vertex, edge.Follows);
  this->Nodes.push_back(
    Node{ 0.5 * (first.Weight + second.Weight), 0.5 * (first.Point + second.Point), side.Middle });
  const Edge whole = edge; // its entry may move
  this->AddUntested(a, whole.Middle, OfHalf * whole.Error, whole.IsSmooth);
  this->AddUntested(whole.Middle, b, OfHalf * whole.Error, whole.IsSmooth);
}

//------------------------------------------------------------------------------
template <std::size_t N>
void EdgeSubdivision::Emit(const Cell& cell, const std::array<std::int32_t, N>& nodes)
{
  for (const std::int32_t index : nodes)
  {
    Node& node = this->Nodes[static_cast<std::size_t>(index)];
    if (node.Output < 0)
    {
      node.Output = static_cast<std::int64_t>(cell.Images->Points.size());
      ImagePoint point;
      point.Vertex = node.Vertex;
      point.SetSource(cell.Ids, node.Weight);
      cell.Images->Points.push_back(point);
    }
    cell.Images->Connectivity.push_back(node.Output);
  }
  cell.Images->EndCell(cell.Source, cell.Orientation);
}

//------------------------------------------------------------------------------
// Tests the sides of some parts of a level.
void EdgeSubdivision::SettleLevel(std::size_t begin, std::size_t end)
{
  this->Tested.clear();
  for (std::size_t i = begin; i < end; ++i)
  {
    const NodeIds& part = this->Level[i];
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->TestEdge(part[k], part[(k + 1) % 3]);
    }
  }
  this->SettleEdges();
}

//------------------------------------------------------------------------------
// Divides a triangle level by level, so that the points of a level are solved side by side.
void EdgeSubdivision::Divide(const Cell& cell)
{
  this->Level.assign(1, { 0, 1, 2 });
  for (int depth = 0; !this->Level.empty() && !this->Failed; ++depth)
  {
    this->NextLevel.clear();
    for (std::size_t i = 0; i < this->Level.size(); ++i)
    {
      if (i % PartsAtOnce == 0 && depth < DeepestLevel)
      {
        this->SettleLevel(i, std::min(i + PartsAtOnce, this->Level.size()));
      }
      this->DividePart(cell, this->Level[i]);
    }
    this->Level.swap(this->NextLevel);
  }
}

//------------------------------------------------------------------------------
// Adds the edges between middles of sides, which are half as long as the side that they are
// parallel to.
void EdgeSubdivision::AddParallels(const EdgesOfPart& edges)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::int32_t a = edges[(k + 1) % 3].Middle;
    const std::int32_t b = edges[(k + 2) % 3].Middle;
    if (a != NotSplit && b != NotSplit)
    {
      this->AddUntested(a, b, OfHalf * edges[k].Error, edges[k].IsSmooth && this->AreSampled(a, b));
    }
  }
}

//------------------------------------------------------------------------------
// The error that is expected of the edge from the node opposite side `k` to the middle of that
// side. Where second derivatives are the same everywhere, the error of an edge is a quadratic form
// of the edge; this one is half of the difference of two sides.
glm::dvec3 EdgeSubdivision::ExpectMedian(const EdgesOfPart& edges, std::size_t k)
{
  return OfHalf * (2.0 * (edges[(k + 2) % 3].Error + edges[(k + 1) % 3].Error) - edges[k].Error);
}

//------------------------------------------------------------------------------
void EdgeSubdivision::AddMedian(const NodeIds& nodes, const EdgesOfPart& edges, std::size_t k)
{
  const glm::dvec3 error = ExpectMedian(edges, k);
  const std::int32_t middle = edges[k].Middle;
  this->AddUntested(nodes[k], middle, error,
    edges[k].Follows && glm::length(error) <= OfHalf * FollowedParts &&
      this->AreSampled(nodes[k], middle));
}

//------------------------------------------------------------------------------
// Emits a part, or adds its parts to the next level.
void EdgeSubdivision::DividePart(const Cell& cell, const NodeIds& nodes)
{
  const EdgesOfPart edges = { this->GetEdge(nodes[1], nodes[2]), this->GetEdge(nodes[2], nodes[0]),
    this->GetEdge(nodes[0], nodes[1]) };
  const auto splits = std::count_if(
    edges.begin(), edges.end(), [](const Edge& edge) { return edge.Middle != NotSplit; });
  if (splits == 0)
  {
    this->Emit(cell, nodes);
    return;
  }
  this->AddParallels(edges);
  // Corners from the one where side k is split and, if two sides are split, the next one as well.
  std::size_t k = 0;
  while (edges[k].Middle == NotSplit || (splits == 2 && edges[(k + 1) % 3].Middle == NotSplit))
  {
    ++k;
  }
  const std::size_t next = (k + 1) % 3;
  const std::size_t last = (k + 2) % 3;
  const NodeIds n = { nodes[k], nodes[next], nodes[last] };
  const NodeIds m = { edges[k].Middle, edges[next].Middle, edges[last].Middle };
  std::vector<NodeIds>& parts = this->NextLevel;
  if (splits == 1)
  {
    this->AddMedian(nodes, edges, k);
    parts.insert(parts.end(), { { n[0], n[1], m[0] }, { n[0], m[0], n[2] } });
    return;
  }
  parts.push_back({ m[0], n[2], m[1] });
  if (splits == 3)
  {
    parts.insert(parts.end(), { { n[0], m[2], m[1] }, { m[2], n[1], m[0] }, { m[2], m[0], m[1] } });
    return;
  }
  // The diagonal of the rest that is expected to be bent less.
  const bool isFirst =
    glm::length(ExpectMedian(edges, k)) <= glm::length(ExpectMedian(edges, next));
  this->AddMedian(nodes, edges, isFirst ? k : next);
  parts.push_back({ n[0], n[1], isFirst ? m[0] : m[1] });
  parts.push_back({ isFirst ? n[0] : n[1], m[0], m[1] });
}

//------------------------------------------------------------------------------
void EdgeSubdivision::DivideLine(const Cell& cell, std::int32_t a, std::int32_t b, int depth)
{
  this->Tested.clear();
  if (depth < DeepestLevel)
  {
    this->TestEdge(a, b);
  }
  this->SettleEdges();
  const std::int32_t middle = this->GetEdge(a, b).Middle;
  if (this->Failed)
  {
    return;
  }
  if (middle == NotSplit)
  {
    this->Emit(cell, std::array<std::int32_t, 2>{ a, b });
    return;
  }
  this->DivideLine(cell, a, middle, depth + 1);
  this->DivideLine(cell, middle, b, depth + 1);
}

//------------------------------------------------------------------------------
bool EdgeSubdivision::AddTriangle(
  const std::array<ImagedPoint, 3>& corners, std::int64_t sourceCell, ImageMesh& images)
{
  const ImageMesh::Mark before = images.GetMark();
  this->Start(corners, 3);
  this->Divide({ { corners[0].Id, corners[1].Id, corners[2].Id }, sourceCell,
    corners[0].Image->Orientation, &images });
  this->Coarse += this->IsFull && !this->Failed ? 1 : 0;
  if (this->Failed)
  {
    images.ReturnTo(before);
  }
  return !this->Failed;
}

//------------------------------------------------------------------------------
bool EdgeSubdivision::AddLine(
  const ImagedPoint& from, const ImagedPoint& to, std::int64_t sourceCell, ImageMesh& images)
{
  const ImageMesh::Mark before = images.GetMark();
  this->Start({ from, to, from }, 2);
  this->DivideLine(
    { { from.Id, to.Id, from.Id }, sourceCell, from.Image->Orientation, &images }, 0, 1, 0);
  if (this->Failed)
  {
    images.ReturnTo(before);
  }
  return !this->Failed;
}

}
