// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/ApparentPlaces.h"

#include "Common/FiniteVector.h"
#include "Refraction/Membrane/CrossProduct.h"
#include "Volume/Graded/GradedPiece.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/**
 * Distance of a ray from a point that counts as none, relative to the larger of the point's
 * distance and 1: 2^-9 of the rounding of the mesh's positions, and far above that of a walk.
 */
constexpr double Reached = 0x1p-40;
/** Difference of slopes for derivatives: half of the digits of a place with errors of some 2^-48.
 */
constexpr double SlopeStep = 0x1p-24;
/** Steps of Newton's method, and divisions of one step by 2 until it leads nearer. */
constexpr int MostSteps = 24;
constexpr int MostDivisions = 8;
/** Images that are nearer to each other than this part of the grid's cell count as one. */
constexpr double OneImage = 1.0 / 256.0;

/** Ends a ray at a plane that it passes along the normal. */
class PlaneVisitor : public GradedRayVisitor
{
public:
  PlaneVisitor(const glm::dvec3& point, const glm::dvec3& normal)
    : Point(point)
    , Normal(normal)
  {
  }

  bool VisitLeg(const GradedLeg& leg) override
  {
    const double begin = this->SideOf(leg.Begin);
    const double rate = glm::dot(leg.Direction, this->Normal);
    if (begin > 0.0 || !(rate > 0.0) || -begin > rate * leg.Length)
    {
      return true;
    }
    this->IsMet = true;
    this->Place = leg.Begin - begin / rate * leg.Direction;
    return false;
  }
  bool VisitArc(GradedArc& arc) override
  {
    if (this->SideOf(arc.Begin) > 0.0 || this->SideOf(arc.End) < 0.0)
    {
      return true;
    }
    // Bisection to the rounding of the share.
    double low = 0.0;
    double high = 1.0;
    this->Place = arc.End;
    for (int step = 0; step < 60 && high > low; ++step)
    {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high)
      {
        break;
      }
      this->Place = arc.At(middle);
      (this->SideOf(this->Place) < 0.0 ? low : high) = middle;
    }
    this->IsMet = true;
    return false;
  }

  bool IsMet = false;
  glm::dvec3 Place{ 0.0 };

private:
  double SideOf(const glm::dvec3& place) const
  {
    return glm::dot(place - this->Point, this->Normal);
  }

  const glm::dvec3 Point;
  const glm::dvec3 Normal;
};

/** Keeps the ends of all pieces in a frame. */
class TrailVisitor : public GradedRayVisitor
{
public:
  TrailVisitor(const glm::dvec3& eye, const HeightFrame& frame, std::vector<glm::dvec3>& trail)
    : Eye(eye)
    , Frame(frame)
    , Trail(trail)
  {
  }

  bool VisitLeg(const GradedLeg& leg) override
  {
    this->Add(leg.Begin);
    // As far as any point is; the last piece goes on for ever.
    this->Add(leg.Begin + std::min(leg.Length, this->Farthest) * leg.Direction);
    return true;
  }
  bool VisitArc(GradedArc& arc) override
  {
    this->Add(arc.End);
    return true;
  }

  double Farthest = 0.0;

private:
  void Add(const glm::dvec3& place)
  {
    const glm::dvec3 inFrame = this->Frame.ToFrame(place - this->Eye);
    // Depths rise: parts of a ray behind the first time at a depth do not count.
    if (this->Trail.empty() || inFrame.z > this->Trail.back().z)
    {
      this->Trail.push_back(inFrame);
    }
  }

  const glm::dvec3 Eye;
  const HeightFrame& Frame;
  std::vector<glm::dvec3>& Trail;
};

/** Place at a depth of a trail; NaN if it does not reach it. */
glm::dvec2 PlaceAt(const std::vector<glm::dvec3>& trail, double depth)
{
  const auto after = std::lower_bound(trail.begin(), trail.end(), depth,
    [](const glm::dvec3& place, double value) { return place.z < value; });
  if (after == trail.begin() || after == trail.end())
  {
    return glm::dvec2(NaN);
  }
  const glm::dvec3& a = *(after - 1);
  const glm::dvec3& b = *after;
  return glm::mix(glm::dvec2(a), glm::dvec2(b), (depth - a.z) / (b.z - a.z));
}

/**
 * True if a triangle has a place in it or on its edge, with the barycentric weights. A triangle
 * with a corner that is NaN has none.
 */
bool HasPlace(
  const std::array<glm::dvec2, 3>& corners, const glm::dvec2& place, std::array<double, 3>& weights)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    weights[i] = Cross(corners[(i + 1) % 3] - place, corners[(i + 2) % 3] - place);
  }
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
}

}

/** A point, and the frame in which its rays are aimed at it. */
struct ApparentPlaces::Aim
{
  glm::dvec3 Point;
  double Distance;
  HeightFrame Frame; ///< along the straight way to it

  glm::dvec3 DirectionOf(const glm::dvec2& slope) const
  {
    return this->Frame.Axis + slope.x * this->Frame.First + slope.y * this->Frame.Second;
  }
};

/** Slope of a ray that meets the point. */
struct ApparentPlaces::Root
{
  glm::dvec2 Slope;
  double Determinant = 0.0;
};

//------------------------------------------------------------------------------
ApparentPlaces::ApparentPlaces(
  const GradedRayWalk& walk, const glm::dvec3& eye, double spread, int resolution)
  : Walk(walk)
  , Eye(eye)
  , Spread(spread)
  , Resolution(resolution)
{
}

//------------------------------------------------------------------------------
std::vector<ApparentPlace> ApparentPlaces::Find(
  const std::vector<glm::dvec3>& points, const RangeLoop& loop)
{
  this->LayGrid(points, loop);
  std::vector<ApparentPlace> places(points.size());
  ForEachItem(points.size(), loop, [&](std::size_t i) { places[i] = this->FindOne(points[i]); });
  return places;
}

//------------------------------------------------------------------------------
/** Follows the rays of a grid around all points that are before the plane across its middle. */
void ApparentPlaces::LayGrid(const std::vector<glm::dvec3>& points, const RangeLoop& loop)
{
  glm::dvec3 sum(0.0);
  double farthest = 0.0;
  for (const glm::dvec3& point : points)
  {
    const glm::dvec3 way = point - this->Eye;
    const double distance = glm::length(way);
    if (IsFinite(way) && distance > 0.0)
    {
      sum += way / distance;
      farthest = std::max(farthest, distance);
    }
  }
  this->Trails.clear();
  const double length = glm::length(sum);
  if (!(length > 0.0))
  {
    return;
  }
  this->Frame = HeightFrame(sum / length);
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& point : points)
  {
    const glm::dvec3 way = point - this->Eye;
    const double depth = this->Frame.GetHeight(way);
    if (IsFinite(way) && depth > 0.0)
    {
      const glm::dvec2 slope = this->Frame.Project(way) / depth;
      low = glm::min(low, slope);
      high = glm::max(high, slope);
    }
  }
  this->Low = low - this->Spread;
  this->Step = (high + this->Spread - this->Low) / static_cast<double>(this->Resolution);
  const auto side = static_cast<std::size_t>(this->Resolution) + 1;
  this->Trails.resize(side * side);
  loop(this->Trails.size(),
    [&](std::size_t begin, std::size_t end)
    {
      GradedRayStatistics statistics;
      for (std::size_t i = begin; i < end; ++i)
      {
        TrailVisitor visitor(this->Eye, this->Frame, this->Trails[i]);
        // A slope makes a depth farther by its angle's cosine.
        visitor.Farthest = 2.0 * farthest * glm::length(glm::dvec3(high - low + this->Spread, 1.0));
        const glm::dvec2 node(static_cast<double>(i % side), static_cast<double>(i / side));
        this->Walk.Follow({ this->Eye, this->DirectionAt(node) }, statistics, visitor);
      }
    });
}

//------------------------------------------------------------------------------
glm::dvec3 ApparentPlaces::DirectionAt(const glm::dvec2& node) const
{
  const glm::dvec2 slope = this->Low + node * this->Step;
  return this->Frame.Axis + slope.x * this->Frame.First + slope.y * this->Frame.Second;
}

//------------------------------------------------------------------------------
/** Nodes of the grid, and places between them, in whose directions a point is about seen. */
std::vector<glm::dvec2> ApparentPlaces::FindSeeds(const glm::dvec3& point) const
{
  std::vector<glm::dvec2> seeds;
  const glm::dvec3 way = point - this->Eye;
  const double depth = this->Frame.GetHeight(way);
  if (this->Trails.empty() || !(depth > 0.0))
  {
    return seeds;
  }
  const glm::dvec2 place = this->Frame.Project(way);
  const int side = this->Resolution + 1;
  std::vector<glm::dvec2> met;
  met.reserve(this->Trails.size());
  for (const auto& trail : this->Trails)
  {
    met.push_back(PlaceAt(trail, depth));
  }
  const auto at = [side](int column, int row)
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
      static_cast<std::size_t>(column);
  };
  for (int row = 0; row < this->Resolution; ++row)
  {
    for (int column = 0; column < this->Resolution; ++column)
    {
      for (const int half : { 0, 1 })
      {
        const glm::dvec2 nodes[3] = { glm::dvec2(column + half, row + half),
          glm::dvec2(column + 1, row), glm::dvec2(column, row + 1) };
        const std::array<glm::dvec2, 3> corners = { met[at(column + half, row + half)],
          met[at(column + 1, row)], met[at(column, row + 1)] };
        std::array<double, 3> weights;
        if (HasPlace(corners, place, weights))
        {
          seeds.push_back(weights[0] * nodes[0] + weights[1] * nodes[1] + weights[2] * nodes[2]);
        }
      }
    }
  }
  return seeds;
}

//------------------------------------------------------------------------------
ApparentPlace ApparentPlaces::FindOne(const glm::dvec3& point) const
{
  ApparentPlace result;
  Aim aim;
  aim.Point = point;
  aim.Distance = glm::length(point - this->Eye);
  if (!std::isfinite(aim.Distance) || !(aim.Distance > 0.0))
  {
    return result;
  }
  result.Direction = (point - this->Eye) / aim.Distance;
  aim.Frame = HeightFrame(result.Direction);
  std::vector<glm::dvec2> starts = { glm::dvec2(0.0) };
  for (const glm::dvec2& seed : this->FindSeeds(point))
  {
    const glm::dvec3 direction = this->DirectionAt(seed);
    const double along = aim.Frame.GetHeight(direction);
    if (along > 0.0)
    {
      starts.push_back(aim.Frame.Project(direction) / along);
    }
  }
  const double same = OneImage * std::min(this->Step.x, this->Step.y);
  std::vector<Root> roots;
  for (const glm::dvec2& start : starts)
  {
    Root root;
    root.Slope = start;
    if (this->Solve(aim, root) &&
      std::none_of(roots.begin(), roots.end(),
        [&](const Root& other) { return glm::distance(other.Slope, root.Slope) <= same; }))
    {
      roots.push_back(root);
    }
  }
  result.Images = static_cast<int>(roots.size());
  const auto isBetter = [](const Root& a, const Root& b)
  {
    const bool upright[2] = { a.Determinant > 0.0, b.Determinant > 0.0 };
    return upright[0] != upright[1] ? upright[0]
                                    : glm::dot(a.Slope, a.Slope) < glm::dot(b.Slope, b.Slope);
  };
  if (!roots.empty())
  {
    const Root& best = *std::min_element(roots.begin(), roots.end(), isBetter);
    result.Orientation = best.Determinant > 0.0 ? 1 : -1;
    result.Direction = glm::normalize(aim.DirectionOf(best.Slope));
  }
  return result;
}

//------------------------------------------------------------------------------
/**
 * Distance by which a ray misses the point, on the plane through it. Returns false if it does not
 * reach that.
 */
bool ApparentPlaces::Miss(const Aim& aim, const glm::dvec2& slope, glm::dvec2& miss) const
{
  PlaneVisitor visitor(aim.Point, aim.Frame.Axis);
  GradedRayStatistics statistics;
  this->Walk.Follow({ this->Eye, aim.DirectionOf(slope) }, statistics, visitor);
  miss = aim.Frame.Project(visitor.Place - aim.Point);
  return visitor.IsMet;
}

//------------------------------------------------------------------------------
/** Follows Newton's method to the slope of a ray that meets the point, if it leads there. */
bool ApparentPlaces::Solve(const Aim& aim, Root& root) const
{
  const double reached = Reached * std::max(1.0, aim.Distance);
  glm::dvec2 miss;
  bool isMet = this->Miss(aim, root.Slope, miss);
  for (int step = 0; step < MostSteps && isMet; ++step)
  {
    glm::dvec2 aside[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      glm::dvec2 slope = root.Slope;
      slope[axis] += SlopeStep;
      if (!this->Miss(aim, slope, aside[axis]))
      {
        return false;
      }
    }
    const glm::dmat2 matrix((aside[0] - miss) / SlopeStep, (aside[1] - miss) / SlopeStep);
    root.Determinant = glm::determinant(matrix);
    if (glm::length(miss) <= reached)
    {
      return true;
    }
    if (!(std::abs(root.Determinant) > 0.0))
    {
      return false;
    }
    glm::dvec2 change = -(glm::inverse(matrix) * miss);
    const double before = glm::length(miss);
    isMet = false;
    for (int division = 0; division < MostDivisions && !isMet; ++division, change *= 0.5)
    {
      glm::dvec2 next;
      if (this->Miss(aim, root.Slope + change, next) && glm::length(next) < before)
      {
        isMet = true;
        root.Slope += change;
        miss = next;
      }
    }
  }
  return false;
}

}
