// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of SightSheet: nodes of a patch, and where its sides are divided.
#include "Refraction/StackImages/SightSheetBuilder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// As in SubCellDivision: lengths of sides, in facets and as angles at the eye, below which they are
// not divided further: facets may be much larger than their distance from the eye.
constexpr double ShortestSide = 1.0 / 32.0;
constexpr double ShortestChord = 1.0 / 256.0;

// Sides that are longer than their distance from the eye are divided in the middle, as if the
// surface had smaller facets, but not below the resolution of places.
constexpr double WidestSide = 1.0;
const double ShortestWideSide = std::ldexp(1.0, -BeamDivision::MostNearLevels);

// Bisections of a limit. Places of nodes have at most 24 binary digits, and one more for each
// division of a side that is too long; middles of sides are exact.
constexpr int LimitSteps = 16;

// Levels to which a side is tested where it passes over many patches of a later surface.
constexpr int DeepestTest = 6;

// Two crossings of a ray with the first surface are one if they are closer, in patch sizes. Near a
// silhouette an error e of the place changes the distance by sqrt(e); e is at most
// PatchCrossings::Border, 1e-8.
constexpr double SameCrossing = 1e-3;

const double Pi = std::acos(-1.0);

// Places around a corner of a border that are traced.
constexpr int PlacesAround = 8;

// Length of a side in barycentric coordinates: the same in both patches at a common edge.
double GetLength(const glm::dvec2& a, const glm::dvec2& b)
{
  const glm::dvec2 side = b - a;
  return std::max({ std::fabs(side.x), std::fabs(side.y), std::fabs(side.x + side.y) });
}

}

//------------------------------------------------------------------------------
// Traces a ray from a place, with no memory of other ones.
int SightSheet::Builder::Trace(const glm::dvec2& b, StackPath& path) const
{
  path.Forget(this->Sheet.Links);
  const PathEnd end = this->Stack.Trace({ this->Facet, b }, this->Sheet.Links, false, path);
  const auto passed = static_cast<int>(path.Count);
  if (end == PathEnd::Missed)
  {
    return passed - 1;
  }
  const bool isFacing = passed > 0 || glm::dot(path.Sight, this->Result.Surface.GetNormal(b)) < 0.0;
  return isFacing ? passed : -1;
}

//------------------------------------------------------------------------------
std::int32_t SightSheet::Builder::Add(const glm::dvec2& b)
{
  StackPath path;
  const int legs = this->Trace(b, path);
  return this->Add(b, path, legs);
}

//------------------------------------------------------------------------------
std::int32_t SightSheet::Builder::Add(const glm::dvec2& b, const StackPath& path, int legs)
{
  Node node;
  node.B = b;
  node.Legs = legs;
  node.Rays = static_cast<int>(path.Count);
  const glm::dvec3& eye = this->Stack.GetEye();
  const glm::dvec3 sight = path.Points[0].Ray.Origin - eye;
  const double distance = glm::length(sight);
  SurfaceCrossing before;
  const double slack = SameCrossing * this->Result.Surface.GetSize();
  node.IsFirst = legs >= 0 &&
    (this->Stack.GetLinks()[0].Surface->IsCrossedOnce(path.Sight) ||
      !this->Stack.FindNext(0, eye, path.Sight, before, distance - slack));
  this->Result.Nodes.push_back(node);
  this->Result.Points.push_back(eye);
  this->Result.Directions.push_back(path.Sight);
  for (std::size_t k = 0; k < this->Sheet.Links; ++k)
  {
    this->Result.Points.push_back(path.Points[k].Ray.Origin);
    this->Result.Directions.push_back(path.Points[k].Ray.Direction);
  }
  return static_cast<std::int32_t>(this->Result.Nodes.size() - 1);
}

//------------------------------------------------------------------------------
// Last leg that is seen at `node` on the side towards `other`.
int SightSheet::Builder::GetLegs(std::int32_t node, std::int32_t other) const
{
  const Node& own = this->Get(node);
  return own.IsAtLimit && this->Get(other).Legs < own.Legs ? own.Beyond : own.Legs;
}

//------------------------------------------------------------------------------
std::int32_t SightSheet::Builder::Split(std::int32_t a, std::int32_t b)
{
  const auto low = static_cast<std::uint64_t>(std::min(a, b));
  const std::uint64_t key = low << 32 | static_cast<std::uint64_t>(std::max(a, b));
  const auto known = this->Sides.find(key);
  if (known != this->Sides.end())
  {
    return known->second;
  }
  const std::int32_t split = this->FindSplit(a, b);
  this->Sides[key] = split;
  return split;
}

//------------------------------------------------------------------------------
// The node that divides a side, or NotSplit.
std::int32_t SightSheet::Builder::FindSplit(std::int32_t a, std::int32_t b)
{
  if (this->IsWide(a, b))
  {
    return this->Add(0.5 * (this->Get(a).B + this->Get(b).B));
  }
  const int legsA = this->GetLegs(a, b);
  const int legsB = this->GetLegs(b, a);
  if (legsA != legsB)
  {
    return legsA > legsB ? this->FindLimit(a, b, legsA) : this->FindLimit(b, a, legsB);
  }
  const std::int32_t atBorder = legsA < 0 ? NotSplit : this->SplitAtBorders(a, b, legsA);
  if (atBorder != NotSplit)
  {
    return atBorder;
  }
  const Node first = this->Get(a);
  const Node second = this->Get(b);
  const bool isChord = first.IsAtLimit && second.IsAtLimit && first.Beyond == second.Beyond;
  if (legsA < 0 || !this->IsLong(first.B, second.B, isChord ? ShortestChord : ShortestSide))
  {
    return NotSplit;
  }
  const glm::dvec2 middle = 0.5 * (first.B + second.B);
  StackPath path;
  const int legs = this->Trace(middle, path);
  const bool isSplit = isChord ? this->IsOffLimit(a, b, 0.5, first.Legs)
                               : legs != legsA || this->IsBent(a, b, 0.0, 1.0, path, legs, 0);
  return isSplit ? this->Add(middle, path, legs) : NotSplit;
}

//------------------------------------------------------------------------------
// Length of a side over the distance of its middle from the eye.
double SightSheet::Builder::GetAngle(const glm::dvec2& a, const glm::dvec2& b) const
{
  const glm::dvec3 eye = this->Stack.GetEye() - this->Stack.GetLinks().front().Shift;
  const glm::dvec3 from = this->Result.Surface.Evaluate(a).Position;
  const glm::dvec3 to = this->Result.Surface.Evaluate(b).Position;
  return glm::length(to - from) / glm::length(0.5 * (from + to) - eye);
}

//------------------------------------------------------------------------------
bool SightSheet::Builder::IsLong(const glm::dvec2& a, const glm::dvec2& b, double least) const
{
  return GetLength(a, b) > least || this->GetAngle(a, b) > least;
}

//------------------------------------------------------------------------------
// True if a side is longer than its distance from the eye.
bool SightSheet::Builder::IsWide(std::int32_t a, std::int32_t b) const
{
  const glm::dvec2& first = this->Get(a).B;
  const glm::dvec2& second = this->Get(b).B;
  return GetLength(first, second) > ShortestWideSide && this->GetAngle(first, second) > WidestSide;
}

//------------------------------------------------------------------------------
RefractedPoint SightSheet::Builder::GetFrom(std::int32_t node, std::size_t leg) const
{
  const std::size_t ray = this->GetRay(node, leg);
  return { { this->Result.Points[ray], glm::dvec3(0.0) }, this->Result.Directions[ray], true };
}

//------------------------------------------------------------------------------
// A node between two borders that a side crosses, where another number of legs is seen than at
// its ends; or NotSplit.
std::int32_t SightSheet::Builder::SplitAtBorders(std::int32_t a, std::int32_t b, int legs)
{
  const int rays = std::min(this->Get(a).Rays, this->Get(b).Rays);
  this->Crossings.clear();
  for (const SightBorders::Edge& edge : this->Near.Edges)
  {
    if (static_cast<int>(edge.Leg) <= rays)
    {
      AddCrossing(edge, this->GetFrom(a, edge.Leg), this->GetFrom(b, edge.Leg), this->Crossings);
    }
  }
  if (this->Crossings.empty())
  {
    return NotSplit;
  }
  for (const std::int32_t end : { a, b })
  {
    if (this->Get(end).IsAtLimit)
    {
      this->Crossings.push_back(end == a ? 0.0 : 1.0);
    }
  }
  const double angle = glm::length(this->GetFrom(a, 0).Ray - this->GetFrom(b, 0).Ray);
  StackPath path;
  for (const double s : FindPlacesBetween(this->Crossings, this->Sheet.Tolerance / angle))
  {
    const glm::dvec2 place = glm::mix(this->Get(a).B, this->Get(b).B, s);
    const int found = this->Trace(place, path);
    // A border that a side runs along crosses it within the tolerance.
    if (found != legs && this->IsOffLimit(a, b, s, std::max(found, legs)))
    {
      return this->Add(place, path, found);
    }
  }
  return NotSplit;
}

//------------------------------------------------------------------------------
double SightSheet::Builder::GetDepth(
  const std::array<std::int32_t, 3>& nodes, const glm::dvec2& place) const
{
  SubCell cell;
  for (std::size_t k = 0; k < 3; ++k)
  {
    cell[k] = { this->Get(nodes[k]).B, this->GetFrom(nodes[k], 0) };
  }
  return GetDepthInCell(cell, place);
}

//------------------------------------------------------------------------------
// The corner of a border that is deepest inside a cell, of those that are not in `tried`; its
// number, or -1 if none is inside by more than the tolerance.
int SightSheet::Builder::FindCorner(
  const std::array<std::int32_t, 3>& nodes, const std::vector<int>& tried, glm::dvec2& place) const
{
  const int rays =
    std::min({ this->Get(nodes[0]).Rays, this->Get(nodes[1]).Rays, this->Get(nodes[2]).Rays });
  int best = -1;
  double most = this->Sheet.Tolerance;
  for (std::size_t i = 0; i < this->Near.Corners.size(); ++i)
  {
    const SightBorders::Corner& corner = this->Near.Corners[i];
    if (static_cast<int>(corner.Leg) > rays)
    {
      continue;
    }
    SubCell cell;
    for (std::size_t k = 0; k < 3; ++k)
    {
      cell[k] = { this->Get(nodes[k]).B, this->GetFrom(nodes[k], corner.Leg) };
    }
    const glm::dvec2 guess = GuessSight(cell, corner.Point);
    const double depth = this->GetDepth(nodes, guess);
    if (depth > most && std::find(tried.begin(), tried.end(), static_cast<int>(i)) == tried.end())
    {
      most = depth;
      best = static_cast<int>(i);
      place = guess;
    }
  }
  return best;
}

//------------------------------------------------------------------------------
// A node at a corner of a border, just where the later surface is seen; or NotSplit.
std::int32_t SightSheet::Builder::AddCorner(const std::array<std::int32_t, 3>& nodes)
{
  glm::dvec2 guess;
  std::vector<int> tried;
  for (int i = this->FindCorner(nodes, tried, guess); i >= 0;
       i = this->FindCorner(nodes, tried, guess))
  {
    const SightBorders::Corner& corner = this->Near.Corners[static_cast<std::size_t>(i)];
    StackPath path;
    const bool isFound = this->Trace(guess, path) >= 0 &&
      Shoot(this->Stack, { corner.Point, corner.Leg }, { this->Facet, guess }, ShotSteps, path) ==
        ShotEnd::Converged &&
      path.Points[0].Place.Facet == this->Facet &&
      this->GetDepth(nodes, path.Points[0].Place.B) > 0.0 &&
      std::all_of(nodes.begin(), nodes.end(),
        [this, &path](std::int32_t node)
        { return glm::length(this->GetFrom(node, 0).Ray - path.Sight) > this->Sheet.Tolerance; });
    const std::int32_t node = isFound ? this->AddNear(path) : NotSplit;
    tried.push_back(i);
    if (node != NotSplit)
    {
      return node;
    }
  }
  return NotSplit;
}

//------------------------------------------------------------------------------
// A node next to the place of a path where most legs are seen, if fewer are seen on another side
// of the place; otherwise NotSplit.
std::int32_t SightSheet::Builder::AddNear(const StackPath& at)
{
  const double perAngle = 1.0 / std::max(glm::length(at.SightBy[0]), glm::length(at.SightBy[1]));
  const glm::dvec2 middle = at.Points[0].Place.B;
  int most = std::numeric_limits<int>::min();
  int least = std::numeric_limits<int>::max();
  glm::dvec2 place;
  StackPath path;
  StackPath atMost;
  for (int k = 0; k < PlacesAround; ++k)
  {
    const double angle = 2.0 * Pi * k / PlacesAround;
    const glm::dvec2 next = middle +
      0.25 * this->Sheet.Tolerance * perAngle * glm::dvec2(std::cos(angle), std::sin(angle));
    const int legs = this->Trace(next, path);
    least = std::min(least, legs);
    if (legs > most)
    {
      most = legs;
      place = next;
      atMost = path;
    }
  }
  if (most == least)
  {
    return NotSplit;
  }
  const std::int32_t added = this->Add(place, atMost, most);
  Node& node = this->Result.Nodes[static_cast<std::size_t>(added)];
  node.IsAtLimit = true;
  node.Beyond = least;
  return added;
}

//------------------------------------------------------------------------------
// Last place, from `seen` towards `other`, where leg `legs` is seen. It may be just beyond
// `seen`.
std::int32_t SightSheet::Builder::FindLimit(std::int32_t seen, std::int32_t other, int legs)
{
  glm::dvec2 last = this->Get(seen).B;
  glm::dvec2 beyond = this->Get(other).B;
  int legsBeyond = this->GetLegs(other, seen);
  StackPath path;
  StackPath atLast;
  int legsAtLast = -1;
  for (int i = 0; i < LimitSteps; ++i)
  {
    const glm::dvec2 middle = 0.5 * (last + beyond);
    const int found = this->Trace(middle, path);
    if (found >= legs)
    {
      last = middle;
      legsAtLast = found;
      atLast = path;
    }
    else
    {
      beyond = middle;
      legsBeyond = found;
    }
  }
  if (legsAtLast < 0)
  {
    return NotSplit; // no ray of this leg between the two nodes
  }
  const std::int32_t limit = this->Add(last, atLast, legs);
  Node& node = this->Result.Nodes[static_cast<std::size_t>(limit)];
  node.IsAtLimit = true;
  node.Beyond = legsBeyond;
  return limit;
}

//------------------------------------------------------------------------------
// True if a place on a side, from 0 to 1, is away from the limit of leg `legs` by more than the
// tolerance, on both sides of it.
bool SightSheet::Builder::IsOffLimit(std::int32_t a, std::int32_t b, double at, int legs) const
{
  const Node& first = this->Get(a);
  const Node& second = this->Get(b);
  const glm::dvec2 along = second.B - first.B;
  const glm::dvec2 middle = glm::mix(first.B, second.B, at);
  const double atEye = glm::length(this->GetPoint(a, 1) - this->GetPoint(b, 1)) /
    glm::length(this->GetPoint(a, 1) - this->Stack.GetEye());
  const glm::dvec2 shift =
    std::min(this->Sheet.Tolerance / atEye, 0.5) * glm::dvec2(-along.y, along.x);
  StackPath path;
  const auto isSeen = [this, legs, &path](const glm::dvec2& place)
  {
    const glm::dvec2 inside = glm::clamp(place, 0.0, 1.0);
    return this->Trace(inside / std::max(1.0, inside.x + inside.y), path) >= legs;
  };
  return isSeen(middle + shift) == isSeen(middle - shift);
}

//------------------------------------------------------------------------------
// True if linear interpolation between the ends of a side has an error above the tolerance at
// the place of `path`, in the middle of the part from `low` to `high`; and in the middles of its
// halves, as long as they pass over several patches of a later surface.
bool SightSheet::Builder::IsBent(std::int32_t a, std::int32_t b, double low, double high,
  const StackPath& path, int legs, int depth) const
{
  const double at = 0.5 * (low + high);
  const double angle = glm::length(this->GetPoint(a, 1) - this->GetPoint(b, 1)) /
    glm::length(path.Points[0].Ray.Origin - this->Stack.GetEye());
  const auto isFar = [this, at, angle](
                       const glm::dvec3& first, const glm::dvec3& second, const glm::dvec3& found)
  {
    const double error = glm::length(found - ((1.0 - at) * first + at * second));
    const double width = glm::length(first - second);
    return angle * std::min(error, width) > this->Sheet.Tolerance * width;
  };
  const int surfaces = std::min(legs + 1, this->Links);
  bool passesOverPatches = false;
  for (int k = 1; k <= surfaces; ++k)
  {
    const PathPoint& point = path.Points[static_cast<std::size_t>(k - 1)];
    if (isFar(this->GetPoint(a, k), this->GetPoint(b, k), point.Ray.Origin))
    {
      return true;
    }
    passesOverPatches = passesOverPatches ||
      (point.Place.Facet != CurvedPatches::NoFacet &&
        (high - low) * glm::length(this->GetPoint(a, k) - this->GetPoint(b, k)) > LargestFootprint *
            this->Stack.GetLinks()[static_cast<std::size_t>(k - 1)]
              .Surface->GetPatches()
              .GetPatch(point.Place.Facet)
              .GetSize());
  }
  if (legs == this->Links)
  {
    const auto last = static_cast<std::size_t>(legs);
    const auto hit = [this, last](std::int32_t node)
    {
      return this->Result.Points[this->GetRay(node, last)] +
        this->Sheet.Farthest * this->Result.Directions[this->GetRay(node, last)];
    };
    const RayJet& ray = path.Points[last - 1].Ray;
    if (isFar(hit(a), hit(b), ray.Origin + this->Sheet.Farthest * ray.Direction))
    {
      return true;
    }
  }
  if (!passesOverPatches || depth == DeepestTest)
  {
    return false;
  }
  StackPath half;
  const auto isHalfBent = [&](double from, double to)
  {
    const double l = 0.5 * (from + to);
    const int found = this->Trace((1.0 - l) * this->Get(a).B + l * this->Get(b).B, half);
    return found != legs || this->IsBent(a, b, from, to, half, legs, depth + 1);
  };
  return isHalfBent(low, at) || isHalfBent(at, high);
}

}
