// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/OpaqueTriangles.h"

#include "Common/PointOrder.h"
#include "Volume/Graded/BoundaryCrossings.h"
#include "Volume/Graded/TriangleCrossing.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus
{

/** A straight piece: Begin + t * Way for t in [0, Most]. */
struct OpaqueTriangles::Chord
{
  glm::dvec3 Begin;
  glm::dvec3 Way;
  double Most;

  TubeBounds Widen(double width) const
  {
    TubeBounds tube;
    tube.StartLow = this->Begin - width;
    tube.StartHigh = this->Begin + width;
    tube.DirectionLow = tube.DirectionHigh = this->Way;
    return tube;
  }
};

namespace
{

/** Largest distance of an arc from its chord that does not count: the error of places. */
constexpr double Flatness = BoundaryCrossings::DistanceError;

/**
 * Growth of boxes, relative to the larger one of the size of the coordinates and 1: far more than
 * the few roundings of 2^-53 of a crossing, and too little to cost time.
 */
constexpr double BoxGrowth = 0x1p-40;

double SizeOf(const glm::dvec3& v)
{
  return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}

/** Corners of a tetrahedron and of a triangle. */
using CellCorners = std::array<glm::dvec3, 4>;
using Corners = std::array<glm::dvec3, 3>;

/** True if a plane across an axis has the cell on one side and the triangle on the other. */
bool AreApart(const glm::dvec3& axis, const CellCorners& cell, const Corners& triangle)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  glm::dvec2 ofCell(infinity, -infinity);
  glm::dvec2 ofTriangle = ofCell;
  // The corners are relative to one of the cell's, which is exact for the cell and off by one
  // rounding of its coordinates for the triangle.
  double size = 1.0;
  for (const glm::dvec3& corner : cell)
  {
    const double at = glm::dot(axis, corner);
    ofCell = { std::min(ofCell.x, at), std::max(ofCell.y, at) };
  }
  for (const glm::dvec3& corner : triangle)
  {
    const double at = glm::dot(axis, corner);
    ofTriangle = { std::min(ofTriangle.x, at), std::max(ofTriangle.y, at) };
    size = std::max(size, SizeOf(corner));
  }
  const double margin = BoxGrowth * size * glm::length(axis);
  return ofCell.x > ofTriangle.y + margin || ofTriangle.x > ofCell.y + margin;
}

/** True if the plane of the triangle or of one of the cell's faces keeps the two apart. */
bool AreApart(const CellCorners& cell, const Corners& triangle)
{
  if (AreApart(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]), cell, triangle))
  {
    return true;
  }
  for (std::size_t i = 0; i < cell.size(); ++i)
  {
    const glm::dvec3& first = cell[i];
    const glm::dvec3 normal = glm::cross(cell[(i + 1) % 4] - first, cell[(i + 2) % 4] - first);
    if (AreApart(normal, cell, triangle))
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
void OpaqueTriangles::Build(
  std::vector<glm::dvec3> points, const std::vector<std::array<std::int32_t, 3>>& triangles)
{
  this->Points = std::move(points);
  this->Triangles = triangles;
  this->Bounds = AxisBox();
  std::vector<AxisBox> boxes;
  boxes.reserve(triangles.size());
  for (const auto& triangle : triangles)
  {
    AxisBox box;
    double size = 1.0;
    for (const std::int32_t corner : triangle)
    {
      const glm::dvec3& point = this->Points[static_cast<std::size_t>(corner)];
      box.Add({ point, point });
      size = std::max(size, SizeOf(point));
    }
    box.Low -= BoxGrowth * size;
    box.High += BoxGrowth * size;
    boxes.push_back(box);
    this->Bounds.Add(box);
  }
  this->Tree.Build(boxes);
}

//------------------------------------------------------------------------------
bool OpaqueTriangles::Meet(const GradedLeg& leg, OpaqueHit& hit) const
{
  return this->MeetLine({ leg.Begin, leg.Direction, leg.Length }, hit);
}

//------------------------------------------------------------------------------
bool OpaqueTriangles::Meet(GradedArc& arc, OpaqueHit& hit) const
{
  return this->MeetPart(arc, { arc.Begin, arc.End - arc.Begin, 1.0 }, 0.0, 1.0, hit);
}

//------------------------------------------------------------------------------
/** Finds the first triangle on a part of an arc. */
bool OpaqueTriangles::MeetPart(
  GradedArc& arc, const Chord& chord, double from, double to, OpaqueHit& hit) const
{
  const double height = arc.GetHeight(from, to);
  if (!this->MayMeet(chord, height + Flatness))
  {
    return false;
  }
  // A division by two leaves a quarter of the height, which no division makes finite.
  const double middle = 0.5 * (from + to);
  if (!(height > Flatness) || !std::isfinite(height))
  {
    if (!this->MeetLine(chord, hit))
    {
      return false;
    }
    const double share =
      glm::dot(hit.Place - chord.Begin, chord.Way) / glm::dot(chord.Way, chord.Way);
    hit.Share = glm::clamp(glm::mix(from, to, share), 0.0, 1.0);
    const glm::dvec3 along = glm::normalize(arc.DirectionAt(hit.Share));
    hit.Direction = glm::dot(along, chord.Way) < 0.0 ? -along : along;
    return true;
  }
  const glm::dvec3 half = arc.At(middle);
  return this->MeetPart(arc, { chord.Begin, half - chord.Begin, 1.0 }, from, middle, hit) ||
    this->MeetPart(arc, { half, chord.Begin + chord.Way - half, 1.0 }, middle, to, hit);
}

//------------------------------------------------------------------------------
/**
 * True if a curve within a distance of a chord may meet a triangle: if it is in the triangle's box
 * and not on one side of its plane.
 */
bool OpaqueTriangles::MayMeet(const Chord& chord, double height) const
{
  bool meets = false;
  this->Tree.Visit(chord.Widen(height), chord.Most,
    [&](std::int32_t item, const TubeRange&)
    {
      const auto& triangle = this->Triangles[static_cast<std::size_t>(item)];
      const glm::dvec3& first = this->Points[static_cast<std::size_t>(triangle[0])];
      const glm::dvec3 normal =
        glm::cross(this->Points[static_cast<std::size_t>(triangle[1])] - first,
          this->Points[static_cast<std::size_t>(triangle[2])] - first);
      const double begin = glm::dot(normal, chord.Begin - first);
      const double end = begin + glm::dot(normal, chord.Way);
      const double margin =
        (height + Flatness * std::max(1.0, SizeOf(first))) * glm::length(normal);
      meets = !(std::min(begin, end) > margin || std::max(begin, end) < -margin);
      return meets ? -1.0 : chord.Most;
    });
  return meets;
}

//------------------------------------------------------------------------------
std::vector<std::uint8_t> OpaqueTriangles::FindCells(
  const TetrahedralMesh& mesh, const RangeLoop& loop) const
{
  const auto& cells = mesh.GetCells();
  std::vector<std::uint8_t> found(cells.size(), 0);
  ForEachItem(cells.size(), loop,
    [&](std::size_t c)
    {
      CellCorners corners;
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        corners[i] = mesh.GetPosition(cells[c].Vertices[i]);
      }
      found[c] = this->MayBeIn(corners) ? MayHaveTriangle : 0;
    });
  return found;
}

//------------------------------------------------------------------------------
/** True unless a plane keeps all triangles apart from a cell. */
bool OpaqueTriangles::MayBeIn(const std::array<glm::dvec3, 4>& cell) const
{
  TubeBounds tube;
  tube.StartLow = glm::min(glm::min(cell[0], cell[1]), glm::min(cell[2], cell[3])) - BoxGrowth;
  tube.StartHigh = glm::max(glm::max(cell[0], cell[1]), glm::max(cell[2], cell[3])) + BoxGrowth;
  tube.DirectionLow = tube.DirectionHigh = glm::dvec3(BoxGrowth);
  const CellCorners corners{ glm::dvec3(0.0), cell[1] - cell[0], cell[2] - cell[0],
    cell[3] - cell[0] };
  bool mayBeIn = false;
  this->Tree.Visit(tube, 1.0,
    [&](std::int32_t item, const TubeRange&)
    {
      const auto& triangle = this->Triangles[static_cast<std::size_t>(item)];
      Corners there;
      for (std::size_t i = 0; i < there.size(); ++i)
      {
        there[i] = this->Points[static_cast<std::size_t>(triangle[i])] - cell[0];
      }
      mayBeIn = !AreApart(corners, there);
      return mayBeIn ? -1.0 : 1.0;
    });
  return mayBeIn;
}

//------------------------------------------------------------------------------
bool OpaqueTriangles::MeetLine(const Chord& chord, OpaqueHit& hit) const
{
  const double square = glm::dot(chord.Way, chord.Way);
  if (!(square > 0.0))
  {
    return false;
  }
  // A crossing at the end of a piece is found by one of the two that share it.
  const double slack = Flatness * std::max(1.0, SizeOf(chord.Begin)) / std::sqrt(square);
  double nearest = std::numeric_limits<double>::infinity();
  this->Tree.Visit(chord.Widen(Flatness), chord.Most + slack,
    [&](std::int32_t item, const TubeRange&)
    {
      const auto& triangle = this->Triangles[static_cast<std::size_t>(item)];
      std::array<glm::dvec3, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
      {
        corners[i] = this->Points[static_cast<std::size_t>(triangle[i])] - chord.Begin;
      }
      const auto isBefore = [this, &triangle](std::size_t a, std::size_t b)
      {
        return IsBefore(this->Points[static_cast<std::size_t>(triangle[a])],
          this->Points[static_cast<std::size_t>(triangle[b])]);
      };
      TriangleCrossing crossing;
      const double limit = std::min(nearest, chord.Most + slack);
      if (!CrossTriangle(corners, isBefore, chord.Way, crossing))
      {
        return limit;
      }
      const double at = glm::dot(crossing.Way, chord.Way) / square;
      if (at < -slack || at > limit || (at == nearest && item > hit.Triangle))
      {
        return limit;
      }
      nearest = at;
      hit.Triangle = item;
      hit.Weights = crossing.Weights;
      hit.IsFront = crossing.IsFront;
      hit.Place = chord.Begin + crossing.Way;
      hit.Direction = chord.Way;
      return nearest;
    });
  return nearest < std::numeric_limits<double>::infinity();
}

namespace
{

/** Ends a ray at the first triangle, and collects the light of a medium in front of it. */
class LightVisitor : public OpaqueVisitor
{
public:
  LightVisitor(const OpaqueTriangles& triangles, const std::vector<std::uint8_t>& cells,
    VolumeLight& light, std::size_t ray)
    : OpaqueVisitor(triangles)
    , Cells(cells)
    , Light(light)
    , Ray(ray)
  {
  }

  bool VisitArc(GradedArc& arc) override
  {
    const std::uint8_t flags = this->Cells[static_cast<std::size_t>(arc.Cell)];
    const bool goesOn = (flags & MayHaveTriangle) == 0 || this->OpaqueVisitor::VisitArc(arc);
    if ((flags & HasLight) != 0)
    {
      this->Light.Add(this->Ray, arc, goesOn ? 1.0 : this->Hit.Share);
    }
    return goesOn;
  }

private:
  const std::vector<std::uint8_t>& Cells;
  VolumeLight& Light;
  std::size_t Ray;
};

void Settle(const GradedRayResult& ray, OpaqueSight& sight)
{
  const bool isHit = sight.Hit.Triangle >= 0;
  sight.Direction = isHit ? sight.Hit.Direction : ray.Direction;
  sight.IsStopped =
    !isHit && (ray.State == GradedRayState::Trapped || ray.State == GradedRayState::Lost);
}

/** Follows rays, each with a visitor of its own. */
template <typename Visitor>
void FollowWatched(const GradedRayWalk& walk, const std::vector<std::uint8_t>& cells,
  const std::vector<GradedRay>& rays, std::vector<Visitor>& visitors,
  GradedRayStatistics& statistics, OpaqueSight* results, const EntryFaces* faces)
{
  GradedWatch watch;
  watch.Cells = &cells;
  for (Visitor& visitor : visitors)
  {
    watch.Visitors.push_back(&visitor);
  }
  std::vector<GradedRayResult> ends(rays.size());
  walk.WalkAll(rays, statistics, ends.data(), BestInstructionSet(), faces, &watch);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    results[i] = OpaqueSight();
    results[i].Hit = visitors[i].Hit;
    Settle(ends[i], results[i]);
  }
}

/** Follows rays outside of whose mesh the triangles are. */
void FollowUnwatched(const GradedRayWalk& walk, const OpaqueTriangles& triangles,
  const std::vector<GradedRay>& rays, GradedRayStatistics& statistics, OpaqueSight* results,
  const EntryFaces* faces)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<GradedRayResult> ends(rays.size());
  walk.WalkAll(rays, statistics, ends.data(), BestInstructionSet(), faces);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const GradedRayResult& ray = ends[i];
    results[i] = OpaqueSight();
    OpaqueHit& hit = results[i].Hit;
    const bool misses = ray.State == GradedRayState::Missed;
    const double length = misses ? infinity : glm::length(ray.Entry - rays[i].Origin);
    if (!triangles.Meet(
          GradedLeg{ rays[i].Origin, glm::normalize(rays[i].Direction), length }, hit) &&
      ray.State == GradedRayState::Left)
    {
      triangles.Meet(GradedLeg{ ray.Exit, ray.Direction, infinity }, hit);
    }
    Settle(ray, results[i]);
  }
}

}

//------------------------------------------------------------------------------
void SeeTriangles(const GradedRayWalk& walk, const OpaqueTriangles& triangles,
  const std::vector<std::uint8_t>* cells, const std::vector<GradedRay>& rays,
  GradedRayStatistics& statistics, OpaqueSight* results, const EntryFaces* faces,
  const EmittingMedium* medium)
{
  if (cells && medium)
  {
    VolumeLight light(*medium, rays.size());
    std::vector<LightVisitor> visitors;
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      visitors.emplace_back(triangles, *cells, light, i);
    }
    FollowWatched(walk, *cells, rays, visitors, statistics, results, faces);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      results[i].Light = light.Get(i);
    }
  }
  else if (cells)
  {
    std::vector<OpaqueVisitor> visitors(rays.size(), OpaqueVisitor(triangles));
    FollowWatched(walk, *cells, rays, visitors, statistics, results, faces);
  }
  else
  {
    FollowUnwatched(walk, triangles, rays, statistics, results, faces);
  }
}

}
