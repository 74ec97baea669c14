// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/EdgeSubdivision.h"

#include "Common/PointOrder.h"
#include "Refraction/Images/ImageTurns.h"

#include <algorithm>
#include <atomic>
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

constexpr std::int32_t NotSplit = -1;

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
  , Cache(std::move(GetSpareCache()))
  , Edges(SmallestEdgeTable, Edge{ 0, NotSplit, 0, false })
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
// The middle is solved from the ends in an order that depends on the ends alone, so that both
// neighbours get the same answer.
EdgeSubdivision::Ends EdgeSubdivision::GetEnds(const glm::dvec3& a, const VirtualVertex& imageOfA,
  const glm::dvec3& b, const VirtualVertex& imageOfB)
{
  return IsBefore(a, b) ? Ends{ { &a, &b }, { &imageOfA, &imageOfB } }
                        : Ends{ { &b, &a }, { &imageOfB, &imageOfA } };
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
const VirtualVertex& EdgeSubdivision::FindMiddle(const glm::dvec3& a, const VirtualVertex& imageOfA,
  const glm::dvec3& b, const VirtualVertex& imageOfB)
{
  const glm::dvec3 point = 0.5 * (a + b);
  Middle& middle = this->FindEntry(point);
  if (!this->IsStored(middle, point))
  {
    const Ends ends = GetEnds(a, imageOfA, b, imageOfB);
    middle.Owner = this->Number;
    middle.Point = point;
    middle.Vertex = this->Geometry.SolveBetween(point, *ends.Image[0], *ends.Image[1]);
    this->SearchIfLost(point, middle.Vertex);
  }
  return middle.Vertex;
}

//------------------------------------------------------------------------------
// Solves the middles that are not stored, side by side. Images of ends must not be stored ones.
void EdgeSubdivision::PrepareMiddles(const Ends* ends, std::size_t count)
{
  std::array<CurvedMembraneSolver::PointBetween, CurvedMembraneSolver::MostBetween> open{};
  std::size_t size = 0;
  const auto solve = [this, &open, &size]()
  {
    this->Geometry.SolveAllBetween(open.data(), size);
    for (std::size_t i = 0; i < size; ++i)
    {
      this->SearchIfLost(open[i].Point, *open[i].Image);
    }
    size = 0;
  };
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 point = ends[i].GetMiddle();
    Middle& middle = this->FindEntry(point);
    if (this->IsStored(middle, point))
    {
      continue;
    }
    const bool isTaken = std::any_of(open.begin(), open.begin() + size,
      [&middle](const auto& other) { return other.Image == &middle.Vertex; });
    if (isTaken || size == open.size())
    {
      solve();
    }
    middle.Owner = this->Number;
    middle.Point = point;
    open[size++] = { point, ends[i].Image[0], ends[i].Image[1], &middle.Vertex };
  }
  solve();
}

//------------------------------------------------------------------------------
// Solves the points on the edges `Tested` that FindShape looks at, side by side.
void EdgeSubdivision::PrepareShapes()
{
  this->TestedImages.clear();
  for (int depth = 0; !this->Tested.empty(); ++depth)
  {
    this->TestedEnds.clear();
    for (const Stretch& part : this->Tested)
    {
      this->TestedEnds.push_back(
        GetEnds(part.Point[0], *part.Image[0], part.Point[1], *part.Image[1]));
    }
    this->PrepareMiddles(this->TestedEnds.data(), this->TestedEnds.size());
    this->NextTested.clear();
    for (const Stretch& part : this->Tested)
    {
      const glm::dvec3 point = 0.5 * (part.Point[0] + part.Point[1]);
      const Middle& middle = this->FindEntry(point);
      if (this->IsStored(middle, point) &&
        this->JudgeMiddle(part, middle.Vertex, depth) == Shape::Undecided)
      {
        this->TestedImages.push_back(middle.Vertex); // its entry may be overwritten
        const std::array<Stretch, 2> halves = Halve(part, this->TestedImages.back());
        this->NextTested.insert(this->NextTested.end(), halves.begin(), halves.end());
      }
    }
    this->Tested.swap(this->NextTested);
  }
}

//------------------------------------------------------------------------------
void EdgeSubdivision::PrepareSides(const std::vector<std::array<ImagedPoint, 2>>& sides)
{
  this->Tested.clear();
  for (const std::array<ImagedPoint, 2>& side : sides)
  {
    this->Tested.push_back(MakeStretch(side[0], side[1]));
  }
  this->PrepareShapes();
}

//------------------------------------------------------------------------------
bool EdgeSubdivision::IsDrawnWell(
  const glm::dvec3& drawn, const VirtualVertex& image, double parts) const
{
  const glm::dvec3 eye = this->Geometry.GetMedia().Eye + this->Geometry.GetMembrane().GetOrigin();
  const glm::dvec3 there = drawn - eye;
  const glm::dvec3 seen = image.Position - eye;
  const glm::dvec3 across = glm::cross(there, seen);
  const double squared = glm::dot(there, there) * glm::dot(seen, seen);
  const double largest = parts * this->Tolerance;
  return glm::dot(across, across) <= largest * largest * squared;
}

//------------------------------------------------------------------------------
double EdgeSubdivision::GetSquaredSize(std::int32_t facet) const
{
  const Membrane& membrane = this->Geometry.GetMembrane();
  const Membrane::Facet& f = membrane.GetFacets()[static_cast<std::size_t>(facet)];
  const auto squared = [&membrane, &f](std::size_t i, std::size_t j)
  {
    const glm::dvec3 edge = membrane.GetPositions()[static_cast<std::size_t>(f[i])] -
      membrane.GetPositions()[static_cast<std::size_t>(f[j])];
    return glm::dot(edge, edge);
  };
  return std::max({ squared(0, 1), squared(1, 2), squared(2, 0) });
}

//------------------------------------------------------------------------------
// True if the sight points are no farther apart than the membrane's vertices there.
bool EdgeSubdivision::AreNeighbours(const VirtualVertex& a, const VirtualVertex& b) const
{
  const glm::dvec3 way = a.SightPoint - b.SightPoint;
  return a.Facet == b.Facet ||
    glm::dot(way, way) <= std::min(this->GetSquaredSize(a.Facet), this->GetSquaredSize(b.Facet));
}

//------------------------------------------------------------------------------
// True if the image of a line may be S-shaped between two points.
bool EdgeSubdivision::MayTurn(const VirtualVertex& a, const VirtualVertex& b) const
{
  const glm::dvec3 eye = this->Geometry.GetMedia().Eye + this->Geometry.GetMembrane().GetOrigin();
  return MayTurnTwice(
    glm::length(glm::normalize(a.Position - eye) - glm::normalize(b.Position - eye)),
    this->Tolerance);
}

//------------------------------------------------------------------------------
// True if the halves of an edge that is divided need no test. An edge whose middle is on its chord
// is divided because of waves between.
bool EdgeSubdivision::AreHalvesSmooth(
  const VirtualVertex& a, const VirtualVertex& middle, const VirtualVertex& b) const
{
  const glm::dvec3 drawn = 0.5 * (a.Position + b.Position);
  return !this->IsDrawnWell(drawn, middle) && this->IsDrawnWell(drawn, middle, TestedParts) &&
    this->AreNeighbours(a, middle) && this->AreNeighbours(middle, b) && !this->MayTurn(a, middle) &&
    !this->MayTurn(middle, b);
}

//------------------------------------------------------------------------------
EdgeSubdivision::Stretch EdgeSubdivision::MakeStretch(const ImagedPoint& a, const ImagedPoint& b)
{
  return { { a.Point, b.Point }, { a.Image->Position, b.Image->Position }, { a.Image, b.Image } };
}

//------------------------------------------------------------------------------
std::array<EdgeSubdivision::Stretch, 2> EdgeSubdivision::Halve(
  const Stretch& part, const VirtualVertex& middle)
{
  const glm::dvec3 point = 0.5 * (part.Point[0] + part.Point[1]);
  const glm::dvec3 drawn = 0.5 * (part.Drawn[0] + part.Drawn[1]);
  return { { { { part.Point[0], point }, { part.Drawn[0], drawn }, { part.Image[0], &middle } },
    { { point, part.Point[1] }, { drawn, part.Drawn[1] }, { &middle, part.Image[1] } } } };
}

//------------------------------------------------------------------------------
// The shape of a part of an edge, as far as its middle tells it.
EdgeSubdivision::Shape EdgeSubdivision::JudgeMiddle(
  const Stretch& part, const VirtualVertex& middle, int depth) const
{
  if (middle.State != ImageState::Found)
  {
    return Shape::Open;
  }
  if (!this->IsDrawnWell(0.5 * (part.Drawn[0] + part.Drawn[1]), middle))
  {
    return Shape::Bent;
  }
  const bool isSampled = this->AreNeighbours(*part.Image[0], middle) &&
    this->AreNeighbours(middle, *part.Image[1]) && !this->MayTurn(*part.Image[0], *part.Image[1]);
  return depth == DeepestLevel || isSampled ? Shape::Straight : Shape::Undecided;
}

//------------------------------------------------------------------------------
EdgeSubdivision::Shape EdgeSubdivision::FindShape(const Stretch& part, int depth)
{
  // A copy, because the next entry may overwrite this one in the cache.
  const VirtualVertex middle =
    this->FindMiddle(part.Point[0], *part.Image[0], part.Point[1], *part.Image[1]);
  Shape shape = this->JudgeMiddle(part, middle, depth);
  if (shape == Shape::Undecided)
  {
    shape = Shape::Straight;
    for (const Stretch& half : Halve(part, middle))
    {
      shape = shape == Shape::Straight ? this->FindShape(half, depth + 1) : shape;
    }
  }
  return shape;
}

//------------------------------------------------------------------------------
EdgeSubdivision::Shape EdgeSubdivision::FindShape(const glm::dvec3& a,
  const VirtualVertex& imageOfA, const glm::dvec3& b, const VirtualVertex& imageOfB)
{
  return this->FindShape(MakeStretch({ -1, a, &imageOfA }, { -1, b, &imageOfB }), 0);
}

//------------------------------------------------------------------------------
bool EdgeSubdivision::IsStraight(const ImagedPoint& a, const ImagedPoint& b)
{
  return this->FindShape(a.Point, *a.Image, b.Point, *b.Image) == Shape::Straight;
}

//------------------------------------------------------------------------------
void EdgeSubdivision::MoveOntoEdge(
  const ImagedPoint& a, const ImagedPoint& b, double l, VirtualVertex& image)
{
  glm::dvec3 point[2] = { a.Point, b.Point };
  VirtualVertex end[2] = { *a.Image, *b.Image };
  bool isStraight = false;
  for (int depth = 0; depth <= DeepestLevel; ++depth)
  {
    const Shape shape = isStraight || depth == DeepestLevel
      ? Shape::Straight
      : this->FindShape(point[0], end[0], point[1], end[1]);
    if (shape == Shape::Open)
    {
      return;
    }
    if (shape == Shape::Straight)
    {
      // Between the tested places the edge deviates little more than at them.
      constexpr double sameBranch = 2.0;
      const glm::dvec3 drawn = (1.0 - l) * end[0].Position + l * end[1].Position;
      image.Position = this->IsDrawnWell(drawn, image, sameBranch) ? drawn : image.Position;
      return;
    }
    const VirtualVertex middle = this->FindMiddle(point[0], end[0], point[1], end[1]);
    isStraight = this->AreHalvesSmooth(end[0], middle, end[1]);
    const int half = l < 0.5 ? 0 : 1;
    point[1 - half] = 0.5 * (point[0] + point[1]);
    end[1 - half] = middle;
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
bool EdgeSubdivision::IsKnown(std::int32_t a, std::int32_t b)
{
  return this->FindEdge(MakeKey(a, b)).Round == this->Round;
}

//------------------------------------------------------------------------------
void EdgeSubdivision::AddEdge(const Edge& edge)
{
  this->FindEdge(edge.Key) = edge;
  if (2 * ++this->EdgeCount > this->Edges.size())
  {
    this->GrowEdges();
  }
}

//------------------------------------------------------------------------------
// Adds an edge that is known to be straight without a test, if it is new.
void EdgeSubdivision::AddStraight(std::int32_t a, std::int32_t b)
{
  if (!this->IsKnown(a, b))
  {
    this->AddEdge({ MakeKey(a, b), NotSplit, this->Round, true });
  }
}

//------------------------------------------------------------------------------
void EdgeSubdivision::GrowEdges()
{
  std::vector<Edge> before(2 * this->Edges.size(), Edge{ 0, NotSplit, this->Round - 1, false });
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
// The node in the middle, or NotSplit if the edge is straight.
std::int32_t EdgeSubdivision::Split(std::int32_t a, std::int32_t b, int depth)
{
  if (depth == DeepestLevel)
  {
    return NotSplit;
  }
  const Edge& known = this->FindEdge(MakeKey(a, b));
  if (known.Round == this->Round)
  {
    return known.Middle;
  }
  const Node& first = this->Nodes[static_cast<std::size_t>(a)];
  const Node& second = this->Nodes[static_cast<std::size_t>(b)];
  const Shape shape = this->FindShape(first.Point, first.Vertex, second.Point, second.Vertex);
  this->Failed = this->Failed || shape == Shape::Open;
  this->IsFull = this->IsFull || (shape == Shape::Bent && this->Nodes.size() >= MostNodes);
  if (shape != Shape::Bent || this->IsFull)
  {
    this->AddEdge({ MakeKey(a, b), NotSplit, this->Round, shape == Shape::Straight });
    return NotSplit;
  }
  const auto result = static_cast<std::int32_t>(this->Nodes.size());
  const Node node{ 0.5 * (first.Weight + second.Weight), 0.5 * (first.Point + second.Point),
    this->FindMiddle(first.Point, first.Vertex, second.Point, second.Vertex) };
  const bool isSmooth = this->AreHalvesSmooth(first.Vertex, node.Vertex, second.Vertex);
  this->Nodes.push_back(node);
  this->AddEdge({ MakeKey(a, b), result, this->Round, isSmooth });
  if (isSmooth)
  {
    this->AddStraight(a, result);
    this->AddStraight(result, b);
  }
  return result;
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
// Solves the points of the sides of some parts of a level that have to be tested.
void EdgeSubdivision::PrepareLevel(std::size_t begin, std::size_t end)
{
  this->Tested.clear();
  for (std::size_t i = begin; i < end; ++i)
  {
    const NodeIds& part = this->Level[i];
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t next = (k + 1) % 3;
      if (!this->IsKnown(part[k], part[next]))
      {
        const Node& a = this->Nodes[static_cast<std::size_t>(part[k])];
        const Node& b = this->Nodes[static_cast<std::size_t>(part[next])];
        this->Tested.push_back(MakeStretch({ -1, a.Point, &a.Vertex }, { -1, b.Point, &b.Vertex }));
      }
    }
  }
  this->PrepareShapes();
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
        this->PrepareLevel(i, std::min(i + PartsAtOnce, this->Level.size()));
      }
      this->DividePart(cell, this->Level[i], depth);
    }
    this->Level.swap(this->NextLevel);
  }
}

//------------------------------------------------------------------------------
// Adds the edges between middles of sides, which are half as long as the side that they are
// parallel to, if that one is smooth.
void EdgeSubdivision::AddParallels(const NodeIds& nodes, const NodeIds& middle)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::int32_t a = middle[(k + 1) % 3];
    const std::int32_t b = middle[(k + 2) % 3];
    if (a == NotSplit || b == NotSplit ||
      !this->FindEdge(MakeKey(nodes[(k + 1) % 3], nodes[(k + 2) % 3])).IsSmooth)
    {
      continue;
    }
    const VirtualVertex& first = this->Nodes[static_cast<std::size_t>(a)].Vertex;
    const VirtualVertex& last = this->Nodes[static_cast<std::size_t>(b)].Vertex;
    if (this->AreNeighbours(first, last) && !this->MayTurn(first, last))
    {
      this->AddStraight(a, b);
    }
  }
}

//------------------------------------------------------------------------------
// Emits a part, or adds its parts to the next level.
void EdgeSubdivision::DividePart(const Cell& cell, const NodeIds& nodes, int depth)
{
  NodeIds middle; // of the edge opposite each node
  for (std::size_t k = 0; k < 3; ++k)
  {
    middle[k] = this->Split(nodes[(k + 1) % 3], nodes[(k + 2) % 3], depth);
  }
  this->AddParallels(nodes, middle);
  const auto splits =
    std::count_if(middle.begin(), middle.end(), [](std::int32_t m) { return m != NotSplit; });
  if (splits == 0)
  {
    this->Emit(cell, nodes);
    return;
  }
  // Rotates the corners so that edge 0 is split and, if two edges are split, edge 1 as well.
  std::size_t k = 0;
  while (middle[k] == NotSplit || (splits == 2 && middle[(k + 1) % 3] == NotSplit))
  {
    ++k;
  }
  const NodeIds n = { nodes[k], nodes[(k + 1) % 3], nodes[(k + 2) % 3] };
  const NodeIds m = { middle[k], middle[(k + 1) % 3], middle[(k + 2) % 3] };
  std::vector<NodeIds>& parts = this->NextLevel;
  if (splits == 1)
  {
    parts.insert(parts.end(), { { n[0], n[1], m[0] }, { n[0], m[0], n[2] } });
    return;
  }
  parts.push_back({ m[0], n[2], m[1] });
  if (splits == 2)
  {
    parts.insert(parts.end(), { { n[0], n[1], m[0] }, { n[0], m[0], m[1] } });
    return;
  }
  parts.insert(parts.end(), { { n[0], m[2], m[1] }, { m[2], n[1], m[0] }, { m[2], m[0], m[1] } });
}

//------------------------------------------------------------------------------
void EdgeSubdivision::DivideLine(const Cell& cell, std::int32_t a, std::int32_t b, int depth)
{
  const std::int32_t middle = this->Split(a, b, depth);
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
