// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackShot.h"

#include "Refraction/Surface/PatchCrossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace meniscus
{
namespace
{

// The error after a step is of the order of the step's square, in units of a facet of each surface
// that the path meets: if the first step is this short, the remaining error is about 1e-12 of a
// facet. Where the eye is closer to the surface than a facet is wide, that distance takes the place
// of the facet's size.
constexpr double ShortStep = 1e-6;

// Newton's method converges quadratically: a step s behind a step r leaves about (s / r^2) s^2.
// Next to a critical angle or a caustic the factor is large. Error, in facets, up to which the step
// s is the last one, and a limit of s: the factor is that of the step before.
constexpr double LargestError = 2e-12;
constexpr double LastStep = 1e-5;

// A step that turns a ray by the angle t turns it by t^2 / (2 c) less or more than its derivatives
// say, where c is the cosine behind the interface, the root in Snell's law: next to a critical
// angle the derivatives change fast. This angle, times the lengths of legs, is the error of a last
// step.
constexpr double LargestTurnError = 1e-11;

// Steps that get no shorter than this part of the one before consist of rounding.
constexpr double Stagnation = 0.5;

// Facets to cross at one step. A longer step has no meaning: the rays between are not like these.
constexpr int LongestMove = 64;

// Halvings of steps that lead to rays which do not pass the stack. After the last of them the end
// of the rays that pass is within 2^-6 of the way to the root, which is beyond. So it is next to a
// critical angle, where the map is the square root of a linear one: a step to a root on this side
// is at most twice as long as the way to the end.
constexpr int Halvings = 6;

// Largest change of a place on any surface, in facets.
double GetLargestMove(const StackPath& path, const glm::dvec2& move)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < path.Count; ++i)
  {
    const PathPoint& point = path.Points[i];
    // Written so that a NaN is kept.
    const double size = GetLargest(GetChange(point.By, move));
    largest = size <= largest ? largest : size;
  }
  return largest;
}

// Moves the path along its derivatives. They are exact within rounding for the last, short step.
void Correct(StackPath& path, const glm::dvec2& move)
{
  for (std::size_t i = 0; i < path.Count; ++i)
  {
    PathPoint& point = path.Points[i];
    RayJet& ray = point.Ray;
    point.Place.B += GetChange(point.By, move);
    ray.Origin += GetChange(ray.OriginBy, move);
    ray.Direction = glm::normalize(ray.Direction + GetChange(ray.DirectionBy, move));
  }
  path.Sight = glm::normalize(path.Sight + GetChange(path.SightBy, move));
}

// Sets first guesses of the crossings behind the first one for the next trace.
void Predict(StackPath& path, const glm::dvec2& move)
{
  for (std::size_t i = 1; i < path.Count; ++i)
  {
    PathPoint& point = path.Points[i];
    point.Place.B += GetChange(point.By, move);
  }
}

// True if the derivatives of all rays hold for the step within LargestTurnError.
bool IsLinear(const RefractionStack& stack, const StackPath& path, const glm::dvec2& move)
{
  for (std::size_t i = 0; i < path.Count; ++i)
  {
    const PathPoint& point = path.Points[i];
    const glm::dvec3 turn = GetChange(point.Ray.DirectionBy, move);
    const double cosine =
      std::sqrt(RefractionRadicand(point.Cosine, stack.GetLinks()[i].Ratio)); // above 0: it passes
    if (!(glm::dot(turn, turn) <= 2.0 * cosine * LargestTurnError))
    {
      return false;
    }
  }
  return true;
}

bool IsLast(const RefractionStack& stack, const StackPath& path, const glm::dvec2& move,
  double size, double before)
{
  const RayJet& first = path.Points[0].Ray;
  const glm::dvec3 shift = GetChange(first.OriginBy, move);
  const double part = size / before; // 0 at the first step
  const bool isLast =
    part > 0.0 ? size < LastStep && part * part * size <= LargestError : size < ShortStep;
  const glm::dvec3 sight = first.Origin - stack.GetEye();
  return isLast && glm::dot(shift, shift) <= ShortStep * ShortStep * glm::dot(sight, sight) &&
    (part >= Stagnation || IsLinear(stack, path, move));
}

// Place in the neighbouring patch where a move leaves the patch; none beyond the surface's border.
std::optional<StackPlace> FindPlaceBeyond(
  const RefractionStack& stack, const StackPlace& place, const glm::dvec2& move)
{
  const CurvedPatches& patches = stack.GetLinks()[0].Surface->GetPatches();
  const int corner = FindOutside(place.B + move).Corner;
  const glm::dvec3 flat = patches.GetPatch(place.Facet).GetFlatPoint(place.B + move);
  const std::int32_t next = patches.GetNeighbour(place.Facet, corner);
  if (next == CurvedPatches::NoFacet)
  {
    return std::nullopt;
  }
  return StackPlace{ next, patches.GetPatch(next).ProjectToFacet(flat) };
}

// Newton's method; `trace(place, off)` sets the path, with an error of the order of the square of
// `off`.
template <typename Tracing>
ShotEnd Iterate(const RefractionStack& stack, const StackTarget& target, StackPlace place,
  int steps, StackPath& path, const Tracing& trace)
{
  StackPlace known = place;
  glm::dvec2 move(0.0);
  int halvings = 0;
  bool isTraced = false;
  // Why a step ends off the surface: it is too long to mean anything, or leads beyond the border.
  const auto leave = [&place]()
  { return GetLargest(place.B) <= LongestMove ? ShotEnd::Outside : ShotEnd::Failed; };
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i)
  {
    double off = 0.0;
    if (trace(place, off) != PathEnd::Passed)
    {
      // Back towards the last place whose ray passes.
      if (!isTraced || ++halvings > Halvings)
      {
        return isTraced ? ShotEnd::Outside : ShotEnd::Failed;
      }
      move *= 0.5;
      place = known;
      before = std::numeric_limits<double>::infinity(); // the next step is no remainder of this one
      if (!Advance(stack, move, place))
      {
        return leave();
      }
      continue;
    }
    isTraced = true;
    known = place;
    const glm::dvec3 nearest = GetNearest(path.GetLast(), target.Point);
    move = GetMove(path.GetLast(), nearest, target.Point - nearest);
    const double size = std::max(GetLargestMove(path, move), off);
    if (!(size <= std::numeric_limits<double>::max()))
    {
      return ShotEnd::Failed;
    }
    const bool isLast = IsLast(stack, path, move, size, before);
    before = size;
    if (isLast && FindOutside(place.B + move).Least >= -PatchCrossings::Border)
    {
      Correct(path, move);
      return ShotEnd::Converged;
    }
    if (isLast)
    {
      // Just outside of the patch: its neighbour takes over.
      const std::optional<StackPlace> beyond = FindPlaceBeyond(stack, place, move);
      if (!beyond)
      {
        return ShotEnd::Outside;
      }
      place = *beyond;
      continue;
    }
    Predict(path, move);
    // The next step is shorter, so that a place that is farther outside does not come back.
    if (!Advance(stack, move, place, std::min(FollowReach, size)))
    {
      return leave();
    }
  }
  return ShotEnd::Failed;
}

}

//------------------------------------------------------------------------------
glm::dvec3 GetNearest(const RayJet& ray, const glm::dvec3& point)
{
  return ray.Origin + glm::dot(point - ray.Origin, ray.Direction) * ray.Direction;
}

//------------------------------------------------------------------------------
// Cramer's rule for x c0 + y c1 + z direction = shift, where c is the change of the ray's point.
glm::dvec2 GetMove(const RayJet& ray, const glm::dvec3& at, const glm::dvec3& shift)
{
  const double distance = glm::dot(at - ray.Origin, ray.Direction);
  const VectorBy by = ray.OriginBy + distance * ray.DirectionBy;
  const glm::dvec3 first = by[0];
  const glm::dvec3 second = by[1];
  const glm::dvec3 across = glm::cross(second, ray.Direction);
  const double inverse = 1.0 / glm::dot(first, across);
  return { inverse * glm::dot(shift, across),
    inverse * glm::dot(first, glm::cross(shift, ray.Direction)) };
}

//------------------------------------------------------------------------------
double GetFootprint(const StackPath& path, std::size_t count)
{
  double largest = 0.0;
  for (std::size_t i = 1; i < count; ++i)
  {
    const PlaceBy& by = path.Points[i].By;
    largest = std::max({ largest, GetLargest(by.U), GetLargest(by.V) });
  }
  return largest;
}

//------------------------------------------------------------------------------
bool Advance(const RefractionStack& stack, const glm::dvec2& move, StackPlace& place, double reach)
{
  place.B += move;
  // Written so that a NaN fails.
  if (!(GetLargest(place.B) <= LongestMove))
  {
    return false;
  }
  if (FindOutside(place.B).Least >= -reach)
  {
    return true;
  }
  const CurvedPatches& patches = stack.GetLinks()[0].Surface->GetPatches();
  const CurvedPatch patch = patches.GetPatch(place.Facet);
  const glm::dvec3 target = patch.GetFlatPoint(place.B);
  const std::int32_t next =
    patches.Walk(place.Facet, target, patch.GetNormal(glm::dvec2(1.0 / 3.0)), LongestMove);
  place = { next, patches.GetPatch(next).ProjectToFacet(target) };
  return FindOutside(place.B).Least >= -FollowReach;
}

//------------------------------------------------------------------------------
ShotEnd Shoot(const RefractionStack& stack, const StackTarget& target, StackPlace place, int steps,
  StackPath& path)
{
  return Iterate(stack, target, place, steps, path,
    [&stack, &target, &path](const StackPlace& at, double&)
    { return stack.Trace(at, target.Count, true, path); });
}

//------------------------------------------------------------------------------
ShotEnd ShootNear(const RefractionStack& stack, const StackTarget& target, StackPlace place,
  int steps, StackPath& path, std::vector<HeldPatch>& held)
{
  return Iterate(stack, target, place, steps, path,
    [&stack, &target, &path, &held](const StackPlace& at, double& off)
    { return stack.TraceStep(at, target.Count, path, held, off); });
}

//------------------------------------------------------------------------------
bool GoesOn(const RefractionStack& stack, const StackTarget& target, const StackPath& path)
{
  if (target.Count == stack.GetLinks().size())
  {
    return true;
  }
  const RayJet& ray = path.GetLast();
  const double distance = glm::dot(target.Point - ray.Origin, ray.Direction);
  SurfaceCrossing next;
  const double slack = stack.GetLinks()[target.Count].Surface->GetSlack(glm::length(target.Point));
  return stack.FindNext(target.Count, ray.Origin, ray.Direction, next) &&
    next.Distance >= distance - slack;
}

//------------------------------------------------------------------------------
bool IsImage(const RefractionStack& stack, const StackTarget& target, const StackPath& path)
{
  const RayJet& ray = path.GetLast();
  const double distance = glm::dot(target.Point - ray.Origin, ray.Direction);
  return distance > 0.0 && stack.IsFirstCrossing(path) && GoesOn(stack, target, path);
}

//------------------------------------------------------------------------------
bool IsBeforeAll(const RefractionStack& stack, const glm::dvec3& point)
{
  const glm::dvec3 away = point - stack.GetEye();
  const double distance = glm::length(away);
  if (!(distance > 0.0))
  {
    return false; // the eye itself
  }
  SurfaceCrossing next;
  const double slack = stack.GetLinks()[0].Surface->GetSlack(glm::length(point));
  return stack.FindNext(0, stack.GetEye(), away / distance, next) &&
    next.Distance >= distance - slack;
}

}
