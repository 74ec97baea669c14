// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/SightBorders.h"

#include "Refraction/Membrane/CrossProduct.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace meniscus
{
namespace
{

// Binary digits of a place on a side: a node that is the sixteenth of these still has exact
// coordinates.
constexpr int MostDigits = 12;

// True if a border that goes on from `last` over `at` to `next` is straight within rounding.
bool IsStraight(
  const glm::dvec3& last, const glm::dvec3& at, const glm::dvec3& next, double rounding)
{
  const glm::dvec3 along = next - last;
  const double length = glm::length(along);
  return glm::length(glm::cross(along, at - last)) <= rounding * length &&
    glm::dot(at - last, along) > 0.0 && glm::dot(next - at, along) > 0.0;
}

}

//------------------------------------------------------------------------------
SightBorders::SightBorders(const StackSolver& solver)
{
  const std::vector<RefractionStack::Link>& links = solver.GetStack().GetLinks();
  for (std::size_t leg = 1; leg < links.size(); ++leg)
  {
    this->AddSurface(links[leg], leg);
  }
}

//------------------------------------------------------------------------------
void SightBorders::AddSurface(const RefractionStack::Link& link, std::size_t leg)
{
  const Membrane& membrane = link.Surface->GetMembrane();
  const std::vector<glm::dvec3>& positions = membrane.GetPositions();
  std::map<std::int32_t, std::vector<std::int32_t>> neighbours;
  for (const SurfaceEdge& border : membrane.GetPieces().Borders)
  {
    const auto [a, b] = border.Ends;
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
    const glm::dvec3 from = positions[static_cast<std::size_t>(a)] + link.Shift;
    const glm::dvec3 to = positions[static_cast<std::size_t>(b)] + link.Shift;
    bool turned = false;
    const ObjectLine line = ObjectLine::Order(from, to, turned);
    this->All.Edges.push_back({ leg, line, { glm::min(from, to), glm::max(from, to) } });
  }
  for (const auto& [vertex, next] : neighbours)
  {
    const glm::dvec3& at = positions[static_cast<std::size_t>(vertex)];
    if (next.size() != 2 ||
      !IsStraight(positions[static_cast<std::size_t>(next[0])], at,
        positions[static_cast<std::size_t>(next[1])], link.Surface->GetSlack(glm::length(at))))
    {
      this->All.Corners.push_back({ leg, at + link.Shift });
    }
  }
}

//------------------------------------------------------------------------------
SightBorders::Borders SightBorders::FindNear(const StackBeams& beams, std::int32_t facet) const
{
  Borders near;
  std::size_t leg = 0;
  std::vector<TubeClip> tube; // of the leg
  const auto mayMeet = [&](std::size_t on, const AxisBox& box)
  {
    if (on != leg)
    {
      leg = on;
      tube.assign(1, TubeClip(beams.GetBounds(facet, leg)));
    }
    const TubeRange range = tube[0].Clip(box, std::numeric_limits<double>::max());
    return beams.GetBounds(facet, leg).IsValid() && range.From <= range.To;
  };
  for (const Edge& edge : this->All.Edges)
  {
    if (mayMeet(edge.Leg, edge.Box))
    {
      near.Edges.push_back(edge);
    }
  }
  for (const Corner& corner : this->All.Corners)
  {
    if (mayMeet(corner.Leg, { corner.Point, corner.Point }))
    {
      near.Corners.push_back(corner);
    }
  }
  return near;
}

//------------------------------------------------------------------------------
void AddCrossing(const SightBorders::Edge& edge, const RefractedPoint& first,
  const RefractedPoint& last, std::vector<double>& places)
{
  const double before = GetMoment(edge.Line, first);
  const double behind = GetMoment(edge.Line, last);
  if ((before < 0.0) == (behind < 0.0))
  {
    return;
  }
  const double s = before / (before - behind);
  const RefractedPoint at{ { glm::mix(first.At.Position, last.At.Position, s), glm::dvec3(0.0) },
    glm::mix(first.Ray, last.Ray, s), true };
  const double l = GetParameter(edge.Line, at);
  if (l >= 0.0 && l <= 1.0)
  {
    places.push_back(s);
  }
}

//------------------------------------------------------------------------------
double GetDepthInCell(const SubCell& sights, const glm::dvec2& place)
{
  const glm::dvec2 origin = sights[0].B;
  const double whole = Cross(sights[1].B - origin, sights[2].B - origin);
  const glm::dvec3 u = sights[1].From.Ray - sights[0].From.Ray;
  const glm::dvec3 v = sights[2].From.Ray - sights[0].From.Ray;
  const double area = glm::length(glm::cross(u, v));
  if (whole == 0.0 || area == 0.0)
  {
    return 0.0; // no place is inside
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
  {
    const SubCellNode& from = sights[(k + 1) % 3];
    const SubCellNode& to = sights[(k + 2) % 3];
    const double part = Cross(to.B - from.B, place - from.B) / whole;
    least = std::min(least, part * area / glm::length(to.From.Ray - from.From.Ray));
  }
  return least;
}

//------------------------------------------------------------------------------
std::vector<double> FindPlacesBetween(std::vector<double>& crossings, double least)
{
  std::sort(crossings.begin(), crossings.end());
  std::vector<double> places;
  for (std::size_t i = 1; i < crossings.size(); ++i)
  {
    const double width = crossings[i] - crossings[i - 1];
    const double middle = 0.5 * (crossings[i] + crossings[i - 1]);
    for (int digits = 1; digits <= MostDigits && width > least; ++digits)
    {
      const double place = std::ldexp(std::round(std::ldexp(middle, digits)), -digits);
      if (std::fabs(place - middle) <= 0.25 * width)
      {
        places.push_back(place);
        break;
      }
    }
  }
  std::sort(places.begin(), places.end(),
    [](double a, double b) { return std::fabs(a - 0.5) < std::fabs(b - 0.5); });
  return places;
}

}
