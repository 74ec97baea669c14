// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/ClosedSurface.h"

#include "Common/FiniteVector.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace meniscus
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

/** Uses of an edge by triangles, in the direction of the larger index and against it. */
struct EdgeUse
{
  int Along = 0;
  int Against = 0;
};

std::size_t CountNotFinite(const TriangleSurface& surface)
{
  return static_cast<std::size_t>(std::count_if(surface.Points.begin(), surface.Points.end(),
    [](const glm::dvec3& point) { return !IsFinite(point); }));
}

// Fault of the edges: open before non-manifold before winding.
SurfaceReport FindEdgeFault(const std::vector<Triangle>& triangles)
{
  std::map<std::pair<int, int>, EdgeUse> edges;
  for (const Triangle& triangle : triangles)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const int from = triangle[corner];
      const int to = triangle[(corner + 1) % 3];
      EdgeUse& use = edges[std::minmax(from, to)];
      ++(from < to ? use.Along : use.Against);
    }
  }
  SurfaceReport open{ SurfaceFault::Open, 0 };
  SurfaceReport nonManifold{ SurfaceFault::NonManifold, 0 };
  SurfaceReport winding{ SurfaceFault::Winding, 0 };
  for (const auto& edge : edges)
  {
    const int uses = edge.second.Along + edge.second.Against;
    open.Count += uses == 1 ? 1 : 0;
    nonManifold.Count += uses > 2 ? 1 : 0;
    winding.Count += uses == 2 && edge.second.Along != 1 ? 1 : 0;
  }
  for (const SurfaceReport& report : { open, nonManifold, winding })
  {
    if (report.Count > 0)
    {
      return report;
    }
  }
  return {};
}

} // anonymous namespace

//------------------------------------------------------------------------------
TriangleSurface JoinCoincidentPoints(
  const std::vector<glm::dvec3>& points, const std::vector<Triangle>& triangles)
{
  TriangleSurface surface;
  std::map<std::tuple<double, double, double>, int> known;
  std::vector<int> local(points.size(), -1);
  const auto find = [&](int source)
  {
    int& index = local[static_cast<std::size_t>(source)];
    if (index < 0)
    {
      const glm::dvec3& point = points[static_cast<std::size_t>(source)];
      const int next = static_cast<int>(surface.Points.size());
      // Coordinates that are not finite have no place in an order; they are faults and stay apart.
      index = IsFinite(point)
        ? known.emplace(std::make_tuple(point.x, point.y, point.z), next).first->second
        : next;
      if (index == next)
      {
        surface.Points.push_back(point);
        surface.Sources.push_back(static_cast<std::size_t>(source));
      }
    }
    return index;
  };
  for (const Triangle& triangle : triangles)
  {
    const Triangle joined{ find(triangle[0]), find(triangle[1]), find(triangle[2]) };
    if (joined[0] != joined[1] && joined[1] != joined[2] && joined[2] != joined[0])
    {
      surface.Triangles.push_back(joined);
    }
  }
  return surface;
}

//------------------------------------------------------------------------------
SurfaceReport FindSurfaceFault(const TriangleSurface& surface)
{
  if (surface.Triangles.empty())
  {
    return { SurfaceFault::Empty, 0 };
  }
  if (const std::size_t count = CountNotFinite(surface))
  {
    return { SurfaceFault::NotFinite, count };
  }
  const SurfaceReport edges = FindEdgeFault(surface.Triangles);
  if (edges.Fault != SurfaceFault::None)
  {
    return edges;
  }
  if (!(ComputeEnclosedVolume(surface) > 0.0))
  {
    return { SurfaceFault::InsideOut, surface.Triangles.size() };
  }
  return {};
}

//------------------------------------------------------------------------------
double ComputeEnclosedVolume(const TriangleSurface& surface)
{
  if (surface.Points.empty())
  {
    return 0.0;
  }
  // Relative to a point of the surface, so that a place far from the origin costs no digits.
  const glm::dvec3& pivot = surface.Points.front();
  double sixfold = 0.0;
  for (const Triangle& triangle : surface.Triangles)
  {
    const auto corner = [&](std::size_t i)
    { return surface.Points[static_cast<std::size_t>(triangle[i])] - pivot; };
    sixfold += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
  }
  return sixfold / 6.0;
}

//------------------------------------------------------------------------------
int ComputeWindingNumber(const TriangleSurface& surface, const glm::dvec3& point)
{
  double angle = 0.0;
  for (const Triangle& triangle : surface.Triangles)
  {
    const auto corner = [&](std::size_t i)
    { return surface.Points[static_cast<std::size_t>(triangle[i])] - point; };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 b = corner(1);
    const glm::dvec3 c = corner(2);
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    // Half of the solid angle of the triangle: Van Oosterom and Strackee (1983).
    angle += std::atan2(glm::dot(a, glm::cross(b, c)),
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  // The sum is a multiple of 2 pi up to rounding, so the nearest one is the answer.
  return static_cast<int>(std::lround(angle / (2.0 * Pi)));
}

} // namespace meniscus
