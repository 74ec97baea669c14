// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Places where interpolation in a sub-cell does not decide which features meet: sides of a narrow
// strip, a primitive that is seen edge-on, and ends next to the membrane.
#include "Refraction/Images/PrimitiveContext.h"
#include "Refraction/Images/PrimitiveMapper.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace meniscus
{
namespace
{

// Limits of a corner: the membrane, and all sides of a triangle.
constexpr unsigned OnMembrane = 1u;
constexpr unsigned AllSides = 0b1110u;

bool IsOneSide(unsigned limits)
{
  return limits == 2u || limits == 4u || limits == 8u;
}

}

//------------------------------------------------------------------------------
// Ray from a side of the sub-cell that meets a side of the primitive. Corners and their order need
// it several times.
const PrimitiveMapper::Meeting& PrimitiveMapper::FindMeeting(
  const Context& context, const SubCell& nodes, int edge, int side) const
{
  Meeting& meeting = (*context.Meetings)[static_cast<std::size_t>(3 * edge + side - 1)];
  if (!meeting.IsKnown)
  {
    const SubCellNode& a = nodes[static_cast<std::size_t>((edge + 1) % 3)];
    const SubCellNode& b = nodes[static_cast<std::size_t>((edge + 2) % 3)];
    const SubCellSide curve(*context.Patch, a.B, b.B);
    const auto k = static_cast<std::size_t>(side);
    const std::size_t turned = context.Sides[k].Turned ? 1 : 0;
    const auto compute = [this, &context, &a, &b, &curve, k]()
    {
      KnownMeetings::Meeting met;
      met.From =
        MeetLine(curve, this->Geometry.GetMedia(), context.Sides[k].Line, a.From, b.From, met.Zero);
      return met;
    };
    const KnownMeetings::Meeting& known = this->Known.Get(
      KnownMeetings::Key::Make(this->Geometry.GetMembrane(), context.Facet, curve,
        context.Primitive.Ids[(k + turned) % 3], context.Primitive.Ids[(k + 1 - turned) % 3]),
      compute);
    meeting = { known.From, curve.IsTurned() ? 1.0 - known.Zero : known.Zero, true };
  }
  return meeting;
}

//------------------------------------------------------------------------------
// The ray of a corner on a side of the primitive.
RefractedPoint PrimitiveMapper::FindRay(const Context& context, const SubCell& nodes,
  const Corner& corner, const ClippedBoundary& on) const
{
  if (on.Node >= 0)
  {
    return nodes[static_cast<std::size_t>(on.Node)].From;
  }
  if (on.Edge < 0)
  {
    // The ray lies in the primitive's plane.
    return RefractAt(context.Patch->Evaluate(corner.B), this->Geometry.GetMedia());
  }
  return this->FindMeeting(context, nodes, on.Edge, on.Side).From;
}

//------------------------------------------------------------------------------
// Scales the values at corners so that they vanish on the sides of the sub-cell where the exact
// ones do, if a side of the sub-cell passes several sides of the primitive. Interpolation alone may
// exchange two of these places where the primitive is seen as a narrow strip; the strip would end
// there. Returns false if there is no such side.
bool PrimitiveMapper::OrderCrossings(
  const Context& context, const SubCell& nodes, Polygon& whole) const
{
  constexpr double nearest = 0x1p-40; // nearer to a corner, rounding decides
  const auto passes = [&whole](std::size_t edge, std::size_t k)
  { return whole[(edge + 1) % 3].Value[k] * whole[(edge + 2) % 3].Value[k] < 0.0; };
  bool isOrdered = false;
  for (std::size_t edge = 0; edge < 3; ++edge)
  {
    if (passes(edge, 1) + passes(edge, 2) + passes(edge, 3) < 2)
    {
      continue;
    }
    for (std::size_t k = 1; k < PrimitiveConstraints; ++k)
    {
      if (!passes(edge, k))
      {
        continue;
      }
      const double place = std::clamp(
        this->FindMeeting(context, nodes, static_cast<int>(edge), static_cast<int>(k)).Place,
        nearest, 1.0 - nearest);
      double& first = whole[(edge + 1) % 3].Value[k];
      double& last = whole[(edge + 2) % 3].Value[k];
      // The corner that is alone on its side of the line keeps its value.
      if (passes((edge + 2) % 3, k))
      {
        last = -first * (1.0 - place) / place;
      }
      else
      {
        first = -last * place / (1.0 - place);
      }
      isOrdered = true;
    }
  }
  return isOrdered;
}

//------------------------------------------------------------------------------
// Finds the ray of the sub-cell that lies in the primitive's plane. Returns false if there is none.
bool PrimitiveMapper::FindEdgeOn(
  const Context& context, const SubCell& nodes, const Polygon& whole, EdgeOn& edgeOn) const
{
  glm::dvec3 away; // of the places from the plane
  glm::dvec3 cosine;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double* value = whole[i].Value;
    away[static_cast<glm::length_t>(i)] = value[0];
    cosine[static_cast<glm::length_t>(i)] = value[1] + value[2] + value[3];
  }
  const auto isMixed = [](const glm::dvec3& v) {
    return std::min({ v.x, v.y, v.z }) < 0.0 && std::max({ v.x, v.y, v.z }) > 0.0;
  };
  if (!isMixed(away) || !isMixed(cosine))
  {
    return false;
  }
  // Both are linear in the sub-cell, and vanish together where their barycentric coordinates are
  // those of the cross product.
  glm::dvec3 place = glm::cross(away, cosine);
  place /= place.x + place.y + place.z;
  edgeOn.B = place.x * nodes[0].B + place.y * nodes[1].B + place.z * nodes[2].B;
  RefractedPoint from;
  if (!MeetPlaneLengthwise(*context.Patch, this->Geometry.GetMedia(), context.Corners[0],
        context.Normal, edgeOn.B, from) ||
    !IsInside(nodes, edgeOn.B))
  {
    return false;
  }
  std::size_t count = 0;
  bool isBehind = false;
  for (unsigned k = 1; k < PrimitiveConstraints && count < 2; ++k)
  {
    const ObjectLine& line = context.Sides[k].Line;
    const double l = GetParameter(line, from);
    if (l > 0.0 && l < 1.0)
    {
      const bool meets = glm::dot(line.GetPoint(l) - from.At.Position, from.Ray) > 0.0;
      edgeOn.Limits[count] = meets ? 1u << k : OnMembrane; // or the ray begins in the primitive
      isBehind = isBehind || meets;
      ++count;
    }
  }
  edgeOn.IsMet = count == 2 && isBehind;
  return true;
}

//------------------------------------------------------------------------------
// True if interpolation lets two sides of the primitive, given by their limits, meet in the
// sub-cell.
bool PrimitiveMapper::MeetInside(const Polygon& whole, unsigned first, unsigned second)
{
  const auto getValues = [&whole](unsigned limit)
  {
    const std::size_t k = limit == 2u ? 1 : (limit == 4u ? 2 : 3);
    return glm::dvec3(whole[0].Value[k], whole[1].Value[k], whole[2].Value[k]);
  };
  const glm::dvec3 place = glm::cross(getValues(first), getValues(second));
  return (place.x > 0.0 && place.y > 0.0 && place.z > 0.0) ||
    (place.x < 0.0 && place.y < 0.0 && place.z < 0.0);
}

//------------------------------------------------------------------------------
// Ends a piece at the ray that lies in the primitive's plane. There the primitive is seen edge-on:
// all of its places on that ray have their image at one sight point, beyond which its other side is
// seen. The four values of a corner vanish together at this point, but their interpolants do not,
// and meet in other places in the interior of the sub-cell. As any two sides of the primitive meet
// at this point, those that interpolation lets meet do not meet in an end of the primitive, and the
// others do. Returns false, and changes nothing, if the piece does not end in the interior.
bool PrimitiveMapper::EndEdgeOn(const EdgeOn& edgeOn, const Polygon& whole, Polygon& polygon)
{
  const std::size_t count = polygon.size();
  const auto isInside = [&polygon, count](std::size_t i) { return polygon[i % count].Edges == 0; };
  std::size_t first = 0; // the first corner after those in the interior
  while (first < count && !(isInside(first + count - 1) && !isInside(first)))
  {
    ++first;
  }
  Polygon kept;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!isInside(first + i))
    {
      kept.push_back(polygon[(first + i) % count]);
    }
  }
  const auto add = [&kept, &edgeOn](unsigned limits)
  {
    Corner corner{};
    corner.B = edgeOn.B;
    corner.Limits = limits;
    kept.push_back(corner);
  };
  // Ends of the primitive between two of its sides.
  const auto addEnds = [&add](unsigned from, unsigned to, bool hasThird)
  {
    const unsigned third = AllSides & ~(from | to);
    if (hasThird)
    {
      add(from | third);
    }
    add((hasThird ? third : from) | to);
  };
  if (kept.empty())
  {
    const auto [from, to] = edgeOn.Limits;
    if (edgeOn.IsMet && IsOneSide(from) && IsOneSide(to))
    {
      add(from);
      add(to);
      addEnds(to, from, MeetInside(whole, from, to));
    }
    polygon.swap(kept); // otherwise only interpolation lets the sides of the primitive enclose it
    return true;
  }
  const unsigned last = kept.back().Limits;
  const unsigned next = kept.front().Limits;
  const auto isKnown = [&edgeOn](unsigned limit)
  {
    return IsOneSide(limit) ||
      (edgeOn.IsMet && (limit == edgeOn.Limits[0] || limit == edgeOn.Limits[1]));
  };
  if (first == count || last == next || !isKnown(last) || !isKnown(next))
  {
    return false;
  }
  if (edgeOn.IsMet)
  {
    const bool isTurned = last == edgeOn.Limits[1] || next == edgeOn.Limits[0];
    const unsigned from = edgeOn.Limits[isTurned ? 1 : 0];
    const unsigned to = edgeOn.Limits[isTurned ? 0 : 1];
    if (last != from)
    {
      add(last | from); // an end of the primitive in the sub-cell
    }
    add(from);
    add(to);
    if (next != to)
    {
      add(next | to);
    }
  }
  else
  {
    addEnds(last, next, count - kept.size() == 1);
  }
  polygon.swap(kept);
  return true;
}

//------------------------------------------------------------------------------
// Sets the values of a corner to its distance behind the membrane, along its ray, and its weights.
void PrimitiveMapper::Locate(const Context& context, const SubCell& nodes, Corner& corner) const
{
  const ClippedBoundary on = context.FindBoundary(corner);
  if (on.Membrane)
  {
    corner.Value[0] = 0.0;
    return;
  }
  if (on.Side < 0)
  {
    const RefractedPoint& from = nodes[static_cast<std::size_t>(on.Node)].From;
    context.Measure(from, corner.Value);
    const double cosine = corner.Value[1] + corner.Value[2] + corner.Value[3];
    for (double& value : corner.Value)
    {
      value /= cosine;
    }
    return;
  }
  std::fill(corner.Value + 1, corner.Value + PrimitiveConstraints, 0.0);
  if (on.End >= 0)
  {
    corner.Value[on.End + 1] = 1.0;
    corner.Value[0] = this->GetDistance(context, nodes, static_cast<std::size_t>(on.End));
    return;
  }
  const RefractedPoint from = this->FindRay(context, nodes, corner, on);
  const Context::Side& side = context.Sides[static_cast<std::size_t>(on.Side)];
  const double l = std::clamp(GetParameter(side.Line, from), 0.0, 1.0);
  corner.Value[(on.Side + (side.Turned ? 1 : 0)) % 3 + 1] = 1.0 - l;
  corner.Value[(on.Side + (side.Turned ? 0 : 1)) % 3 + 1] = l;
  corner.Value[0] = glm::dot(side.Line.GetPoint(l) - from.At.Position, from.Ray);
}

//------------------------------------------------------------------------------
// Distance of an end behind the membrane, along its ray.
double PrimitiveMapper::GetDistance(
  const Context& context, const SubCell& nodes, std::size_t end) const
{
  PatchPoint at;
  if (this->SolveEnd(context, nodes, end, at))
  {
    const RefractedPoint from = RefractAt(at, this->Geometry.GetMedia());
    return glm::dot(context.Corners[end] - at.Position, from.Ray);
  }
  const KnownImages& known = context.Primitive.Images[end];
  const bool isInFront = known.Count == 1 && known.First->Vertex.Facet == CurvedPatches::NoFacet;
  return isInFront ? -GetSize(nodes) : GetSize(nodes);
}

//------------------------------------------------------------------------------
// Drops crossings of sides with the membrane that EndEdgeOn has added in the interior, if the side
// goes on in front of the membrane: the cut then leaves the sub-cell before it meets the side.
void PrimitiveMapper::DropUnmetEnds(Polygon& polygon)
{
  const std::size_t count = polygon.size();
  Polygon kept;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Corner& corner = polygon[i];
    const unsigned sides = corner.Limits & AllSides;
    const auto isInFront = [sides](const Corner& other)
    { return (other.Limits & sides) != 0 && other.Value[0] < 0.0; };
    const bool isUnmet = corner.Edges == 0 && (corner.Limits & OnMembrane) != 0 && sides != 0 &&
      (isInFront(polygon[(i + 1) % count]) || isInFront(polygon[(i + count - 1) % count]));
    if (!isUnmet)
    {
      kept.push_back(corner);
    }
  }
  polygon.swap(kept);
}

//------------------------------------------------------------------------------
// Cuts the part of a primitive behind the membrane between corners on different sides of it, each
// of which is determined by itself: neighbours agree on it. Interpolation may put an end next to
// the membrane on its other side, and the waterline on the wrong side of a narrow strip. Returns
// false if the primitive lies in the membrane, or if that does not cut the part once.
bool PrimitiveMapper::CutAtMembrane(const Context& context, const SubCell& nodes,
  const Polygon& whole, double sign, const EdgeOn& edgeOn, Polygon& polygon) const
{
  const auto isTied = [](const Corner& corner) { return corner.Value[0] == 0.0; };
  if (std::all_of(whole.begin(), whole.end(), isTied))
  {
    return false;
  }
  Polygon uncut = whole;
  for (Corner& corner : uncut)
  {
    corner.Value[0] = 0.0;
  }
  context.Clip(Polygon(uncut), sign, uncut);
  if (edgeOn.IsThere)
  {
    EndEdgeOn(edgeOn, whole, uncut);
  }
  for (Corner& corner : uncut)
  {
    this->Locate(context, nodes, corner);
  }
  DropUnmetEnds(uncut);
  polygon.clear();
  int crossings = 0;
  for (std::size_t i = 0; i < uncut.size(); ++i)
  {
    const Corner& from = uncut[i];
    const Corner& to = uncut[(i + 1) % uncut.size()];
    if (from.Value[0] >= 0.0)
    {
      polygon.push_back(from);
    }
    if ((from.Value[0] >= 0.0) != (to.Value[0] >= 0.0))
    {
      ++crossings;
      if (((from.Limits | to.Limits) & OnMembrane) != 0)
      {
        continue; // one of the two is the crossing
      }
      polygon.push_back(context.Cross(from, to, 0));
      if (polygon.back().Edges == 0 && polygon.back().Limits == OnMembrane)
      {
        return false;
      }
    }
  }
  return crossings <= 2;
}

}
