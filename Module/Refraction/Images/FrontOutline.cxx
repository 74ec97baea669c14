// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/FrontOutline.h"

#include "Common/PointOrder.h"

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

// Barycentric coordinates are at most 1 and carry one or two roundings; a product of two
// differences of them carries a few times as many.
constexpr double Rounding = 16.0 * std::numeric_limits<double>::epsilon();

// Twice the signed area in the second and third barycentric coordinates.
double GetArea(const TrianglePoint& first, const TrianglePoint& second, const TrianglePoint& third)
{
  const glm::dvec3& a = first.Weight;
  const glm::dvec3& b = second.Weight;
  const glm::dvec3& c = third.Weight;
  return (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
}

bool IsConvex(const FrontOutline::Polygon& polygon)
{
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (GetArea(polygon[i], polygon[(i + 1) % count], polygon[(i + 2) % count]) < -Rounding)
    {
      return false;
    }
  }
  return true;
}

// True if the triangle at corner `i` holds no other corner.
bool IsEar(const FrontOutline::Polygon& polygon, std::size_t i)
{
  const std::size_t count = polygon.size();
  const TrianglePoint& a = polygon[(i + count - 1) % count];
  const TrianglePoint& b = polygon[i];
  const TrianglePoint& c = polygon[(i + 1) % count];
  if (GetArea(a, b, c) < 0.0)
  {
    return false;
  }
  return std::none_of(polygon.begin(), polygon.end(),
    [&a, &b, &c](const TrianglePoint& p)
    {
      return p.Weight != a.Weight && p.Weight != b.Weight && p.Weight != c.Weight &&
        GetArea(a, b, p) >= 0.0 && GetArea(b, c, p) >= 0.0 && GetArea(c, a, p) >= 0.0;
    });
}

// Ear clipping. Returns false if rounding leaves no ear.
bool SplitPolygon(FrontOutline::Polygon polygon, std::vector<FrontOutline::Polygon>& parts)
{
  while (!IsConvex(polygon))
  {
    std::size_t ear = 0;
    while (ear < polygon.size() && !IsEar(polygon, ear))
    {
      ++ear;
    }
    if (ear == polygon.size())
    {
      return false;
    }
    const std::size_t count = polygon.size();
    parts.push_back(
      { polygon[(ear + count - 1) % count], polygon[ear], polygon[(ear + 1) % count] });
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  parts.push_back(std::move(polygon));
  return true;
}

}

//------------------------------------------------------------------------------
FrontOutline::FrontOutline(const std::vector<WaterlinePiece>& waterline,
  const std::array<glm::dvec3, 3>& corners, const std::array<bool, 3>& isFront)
  : IsFront(isFront)
{
  for (glm::length_t k = 0; k < 3; ++k)
  {
    glm::dvec3 weight(0.0);
    weight[k] = 1.0;
    this->FindNode({ weight, corners[static_cast<std::size_t>(k)] });
  }
  for (const WaterlinePiece& piece : waterline)
  {
    this->Broken = !this->Link(piece) || this->Broken;
  }
}

//------------------------------------------------------------------------------
std::size_t FrontOutline::FindNode(const TrianglePoint& place)
{
  const auto at = std::lower_bound(this->Sorted.begin(), this->Sorted.end(), place.Weight,
    [this](std::size_t node, const glm::dvec3& weight)
    { return IsBefore(this->Nodes[node].At.Weight, weight); });
  if (at != this->Sorted.end() && this->Nodes[*at].At.Weight == place.Weight)
  {
    this->Nodes[*at].At.Position = place.Position; // a corner: the position that the refracted part
                                                   // uses
    return *at;
  }
  this->Sorted.insert(at, this->Nodes.size());
  this->Nodes.push_back({ place });
  return this->Nodes.size() - 1;
}

//------------------------------------------------------------------------------
// Links the ends of a piece. The part behind the membrane is on the left of the piece, the part in
// front on the left of the reversed piece. Two opposite copies of a piece cancel out.
bool FrontOutline::Link(const WaterlinePiece& piece)
{
  const std::size_t from = this->FindNode(piece.To);
  const std::size_t to = this->FindNode(piece.From);
  if (from == to || (this->Unlink(from, to) && this->Unlink(to, from)))
  {
    return true;
  }
  return this->AddLink(from, to, true) && this->AddLink(to, from, false);
}

//------------------------------------------------------------------------------
bool FrontOutline::AddLink(std::size_t from, std::size_t to, bool isForward)
{
  Node& node = this->Nodes[from];
  const std::size_t place = node.Next[0] == None ? 0 : 1;
  if (node.Next[place] != None)
  {
    return false;
  }
  node.Next[place] = to;
  node.IsForward[place] = isForward;
  return true;
}

//------------------------------------------------------------------------------
bool FrontOutline::Unlink(std::size_t from, std::size_t to)
{
  Node& node = this->Nodes[from];
  for (std::size_t& next : node.Next)
  {
    if (next == to)
    {
      next = None;
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Links the parts of the side from one corner to the next that are in front.
bool FrontOutline::FollowSide(std::size_t from)
{
  const std::size_t to = (from + 1) % 3;
  const auto outside = static_cast<glm::length_t>((from + 2) % 3);
  const auto along = static_cast<glm::length_t>(to);
  std::vector<std::size_t> stops;
  for (std::size_t i = 3; i < this->Nodes.size(); ++i)
  {
    if (this->Nodes[i].At.Weight[outside] == 0.0 && this->IsEnd(i))
    {
      stops.push_back(i);
    }
  }
  std::sort(stops.begin(), stops.end(),
    [this, along](std::size_t a, std::size_t b)
    { return this->Nodes[a].At.Weight[along] < this->Nodes[b].At.Weight[along]; });
  // The curve may end exactly in a corner, which may have been counted to either side.
  const bool isOdd = stops.size() % 2 == 1;
  if (isOdd != (this->IsFront[from] != this->IsFront[to]))
  {
    if (!this->IsEnd(from) && !this->IsEnd(to))
    {
      return false;
    }
    stops.insert(this->IsEnd(from) ? stops.begin() : stops.end(), this->IsEnd(from) ? from : to);
  }
  bool isFront = this->IsFront[from];
  std::size_t last = from;
  stops.push_back(to);
  for (std::size_t i = 0; i < stops.size(); ++i)
  {
    const std::size_t stop = stops[i];
    if (isFront && last != stop)
    {
      this->Nodes[last].Along = stop;
    }
    isFront = isFront != (i + 1 < stops.size());
    last = stop;
  }
  return true;
}

//------------------------------------------------------------------------------
// Next node of the outline: along the triangle's side where that is in front, otherwise along the
// waterline, away from the node `before`. If that is None, the direction is the one with the part
// in front on its left.
std::size_t FrontOutline::GoOn(std::size_t index, std::size_t before) const
{
  const Node& node = this->Nodes[index];
  if (node.Along != None)
  {
    return node.Along;
  }
  const bool isSecond =
    node.Next[0] == None || node.Next[0] == before || (before == None && !node.IsForward[0]);
  return node.Next[isSecond ? 1 : 0];
}

//------------------------------------------------------------------------------
bool FrontOutline::CollectLoop(
  std::size_t first, std::vector<bool>& seen, std::vector<Polygon>& polygons)
{
  Polygon loop;
  double area = 0.0;
  std::size_t node = first;
  std::size_t before = None;
  do
  {
    const std::size_t next = this->GoOn(node, before);
    if (seen[node] || next == None)
    {
      return false;
    }
    seen[node] = true;
    loop.push_back(this->Nodes[node].At);
    area += GetArea(loop.front(), this->Nodes[node].At, this->Nodes[next].At);
    // At a node on a side, the waterline can be followed in one direction only.
    before = this->Nodes[node].Along != None ? None : node;
    before = before == None && this->IsEnd(next) ? next : before;
    node = next;
  } while (node != first);
  if (loop.size() < 3 || std::fabs(area) <= Rounding)
  {
    return true;
  }
  return area > 0.0 && SplitPolygon(std::move(loop), polygons);
}

//------------------------------------------------------------------------------
bool FrontOutline::Find(std::vector<Polygon>& polygons)
{
  polygons.clear();
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Broken = this->Broken || !this->FollowSide(k);
  }
  for (std::size_t i = 3; i < this->Nodes.size() && !this->Broken; ++i)
  {
    // An end of the curve that lies on no side.
    this->Broken = this->IsEnd(i) && this->Nodes[i].At.Weight.x != 0.0 &&
      this->Nodes[i].At.Weight.y != 0.0 && this->Nodes[i].At.Weight.z != 0.0;
  }
  // Loops with sides come first; the others consist of the waterline alone.
  std::vector<bool> seen(this->Nodes.size(), false);
  for (const bool hasSide : { true, false })
  {
    for (std::size_t i = 0; i < this->Nodes.size() && !this->Broken; ++i)
    {
      const Node& node = this->Nodes[i];
      const bool isIn = hasSide ? node.Along != None : node.Next[0] != None || node.Next[1] != None;
      this->Broken = isIn && !seen[i] && !this->CollectLoop(i, seen, polygons);
    }
  }
  return !this->Broken;
}

}
