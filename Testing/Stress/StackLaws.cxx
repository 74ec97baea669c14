// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackChecker.h"

#include "Refraction/Stack/StackInverse.h"

namespace meniscus::test
{

namespace
{

// The round trip's goal, relative to the size of the scene.
constexpr double RoundTrip = 1e-9;

std::optional<glm::dvec3> RefractRay(
  const glm::dvec3& direction, const glm::dvec3& normal, double ratio, double& radicand)
{
  const glm::dvec3 along = ratio * (direction - glm::dot(direction, normal) * normal);
  radicand = 1.0 - glm::dot(along, along);
  if (radicand <= 0.0)
  {
    return std::nullopt;
  }
  return along - std::sqrt(radicand) * normal;
}

bool IsFinite(const glm::dvec3& v)
{
  return std::isfinite(v.x + v.y + v.z);
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<PatchHit> StackChecker::FindCrossings(std::size_t k, const glm::dvec3& origin,
  const glm::dvec3& direction, PatchTracer::Sides sides) const
{
  const TracedSurface& surface = this->GetSurface(k);
  std::vector<PatchHit> hits = surface.Tracer->FindCrossings(
    origin - surface.Shift, direction, this->GetLayer(k).FromFront, 0.0, sides);
  for (PatchHit& hit : hits)
  {
    hit.Position += surface.Shift;
  }
  return hits;
}

//------------------------------------------------------------------------------
PatchHit StackChecker::Evaluate(std::size_t k, std::int32_t facet, const glm::dvec2& b) const
{
  const TracedSurface& surface = this->GetSurface(k);
  PatchHit hit = surface.Tracer->Evaluate(facet, b, this->GetLayer(k).FromFront);
  hit.Position += surface.Shift;
  return hit;
}

//------------------------------------------------------------------------------
TracedPath StackChecker::Trace(const PatchHit& first) const
{
  TracedPath path;
  glm::dvec3 direction = glm::normalize(first.Position - this->Eye);
  PatchHit hit = first;
  for (std::size_t k = 0; k < this->Layers.size(); ++k)
  {
    if (k > 0)
    {
      const std::vector<PatchHit> hits =
        this->FindCrossings(k, path.Points.back().Position, direction);
      if (hits.empty())
      {
        path.End = PathEnd::Missed;
        return path;
      }
      hit = hits.front();
      const double size = this->GetSurface(k).Tracer->GetSize(hit.Facet);
      for (const PatchHit& other : hits)
      {
        // Another crossing as close, or one that the ray hardly makes.
        path.IsCertain = path.IsCertain &&
          (glm::length(other.Position - hit.Position) < 1e-9 * size ||
            other.Distance > hit.Distance + Marginal * size);
      }
    }
    const StackLayer& layer = this->GetLayer(k);
    double radicand = 0.0;
    const auto refracted =
      RefractRay(direction, hit.Normal, layer.GetBefore() / layer.GetBehind(), radicand);
    path.IsCertain = path.IsCertain && std::fabs(radicand) > Marginal * Marginal &&
      -glm::dot(direction, hit.Normal) > Marginal &&
      !this->GetSurface(k).Tracer->IsAtBorder(hit.Facet, hit.B, AtBorder);
    if (!refracted)
    {
      path.End = PathEnd::Reflected;
      return path;
    }
    direction = *refracted;
    path.Points.push_back(hit);
    path.Directions.push_back(direction);
  }
  return path;
}

//------------------------------------------------------------------------------
double StackChecker::GetCondition(const TracedPath& path, const glm::dvec3& point) const
{
  const std::size_t count = path.Points.size();
  return MeasureCondition(path.Points.front().B, point, path.Directions.back(),
    [&](const glm::dvec2& b) -> std::optional<NearRay>
    {
      const TracedPath near = this->Trace(this->Evaluate(0, path.Points.front().Facet, b));
      if (near.Points.size() < count)
      {
        return std::nullopt;
      }
      return NearRay{ near.Points[count - 1].Position, near.Directions[count - 1] };
    });
}

//------------------------------------------------------------------------------
void StackChecker::CheckImage(int i, const glm::dvec3& point, const StackPath& path)
{
  const StackVertex vertex = this->Solver.MakeVertex(this->ToWorld(point), path);
  if (!this->CheckLaw(i, point, path))
  {
    return;
  }
  if (!this->CheckNearest(point, path))
  {
    this->Tally.Count(&RefractionTally::False, i,
      "crosses a surface earlier, or not at all; interfaces", path.Count);
    return;
  }
  this->CheckVertex(i, point, path, vertex);
  this->CheckWayBack(i, point, path, vertex);
}

//------------------------------------------------------------------------------
// n1 times the part of the incoming unit vector along the surface is n2 times that of the outgoing
// one. Positions are off by Rest of a facet, which turns a leg by that over its length, and the
// normal by at most that over a facet's size, times the turn of the normals within it.
bool StackChecker::CheckLaw(int i, const glm::dvec3& point, const StackPath& path)
{
  glm::dvec3 before = this->Eye;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const PathPoint& at = path.Points[k];
    const PatchHit hit = this->Evaluate(k, at.Place.Facet, at.Place.B);
    const double size = this->GetSurface(k).Tracer->GetSize(hit.Facet);
    const double off = Rest * size + 4.0 * this->Rounding;
    if (!(glm::length(hit.Position - at.Ray.Origin) <= off) || !(hit.Inside > -SamePlace))
    {
      this->Tally.Count(&RefractionTally::False, i, "sight point is not on the surface", k);
      return false;
    }
    const glm::dvec3 next = k + 1 < path.Count ? path.Points[k + 1].Ray.Origin : point;
    const double in = glm::length(at.Ray.Origin - before);
    const double out = glm::length(next - at.Ray.Origin);
    const glm::dvec3 a = (at.Ray.Origin - before) / in;
    const glm::dvec3 b = (next - at.Ray.Origin) / out;
    const StackLayer& layer = this->GetLayer(k);
    const auto along = [&hit](const glm::dvec3& v)
    { return v - glm::dot(v, hit.Normal) * hit.Normal; };
    const double residual =
      glm::length(layer.GetBefore() * along(a) - layer.GetBehind() * along(b));
    const double most = std::max(layer.GetBefore(), layer.GetBehind());
    const double tolerance = most * off * (2.0 / in + 2.0 / out + 8.0 / size);
    // At grazing incidence the sign of the cosine is within the same tolerance.
    if (!(residual <= tolerance) || !(glm::dot(a, hit.Normal) < tolerance) ||
      !(glm::dot(b, hit.Normal) < tolerance))
    {
      this->Tally.Count(&RefractionTally::False, i, "Snell's law is off by", residual);
      return false;
    }
    if (std::min(in, out) > size)
    {
      this->Tally.Largest = std::max(this->Tally.Largest, residual);
    }
    before = at.Ray.Origin;
  }
  return true;
}

//------------------------------------------------------------------------------
// Each leg ends at its nearest crossing; the last one goes on to the next surface, if there is one.
bool StackChecker::CheckNearest(const glm::dvec3& point, const StackPath& path) const
{
  glm::dvec3 origin = path.Count > 0 ? path.Points[0].Ray.Origin : this->Eye;
  for (std::size_t k = path.Count > 0 ? 1 : 0; k <= path.Count && k < this->Layers.size(); ++k)
  {
    const bool isLast = k == path.Count;
    const glm::dvec3 end = isLast ? point : path.Points[k].Ray.Origin;
    const double length = glm::length(end - origin);
    const std::vector<PatchHit> hits = this->FindCrossings(k, origin, (end - origin) / length);
    const double size = this->GetSurface(k).Tracer->GetSize(0);
    const double same = SamePlace * size + 8.0 * this->Rounding;
    for (const PatchHit& hit : hits)
    {
      const bool isClear =
        -glm::dot(hit.Normal, (end - origin) / length) > Marginal && hit.Inside > AtBorder;
      if (isClear && hit.Distance > same && hit.Distance < length - same)
      {
        return false;
      }
    }
    // A ray that meets the surface from the right side of its shape is not missed, even if it is on
    // the wrong side of the interpolated normal.
    if (isLast && hits.empty() &&
      this->FindCrossings(k, origin, (end - origin) / length, PatchTracer::Sides::ByShape).empty())
    {
      return false;
    }
    origin = end;
  }
  return true;
}

//------------------------------------------------------------------------------
void StackChecker::CheckVertex(
  int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex)
{
  const bool isFinite = IsFinite(vertex.Position) && IsFinite(vertex.SightPoint) &&
    IsFinite(vertex.LastSightPoint) && std::isfinite(vertex.Depth);
  const bool isInRange = vertex.Reflectance >= 0.0 && vertex.Reflectance <= 1.0 &&
    vertex.Transmittance >= 0.0 && vertex.Transmittance <= 1.0;
  if (!isFinite || !isInRange)
  {
    this->Tally.Count(
      &RefractionTally::Wrong, i, "not a number, or a share beyond 0 and 1", path.Count);
    return;
  }
  glm::dvec3 expected = point;
  double depth = 0.0;
  if (path.Count > 0)
  {
    double optical = 0.0;
    for (std::size_t k = 0; k < path.Count; ++k)
    {
      const glm::dvec3 next = k + 1 < path.Count ? path.Points[k + 1].Ray.Origin : point;
      const double leg = glm::length(next - path.Points[k].Ray.Origin);
      depth += leg;
      optical += leg / this->GetLayer(k).GetBehind();
    }
    const glm::dvec3 sight = path.Points[0].Ray.Origin - this->Eye;
    expected = path.Points[0].Ray.Origin +
      this->GetLayer(0).GetBefore() * optical / glm::length(sight) * sight;
  }
  // The direction has the rounding of both ends over their distance.
  const double sight = path.Count > 0 ? glm::length(path.Points[0].Ray.Origin - this->Eye) : 1.0;
  const double rounding = 8.0 * this->Rounding * (1.0 + 4.0 * depth / sight) + 1e-13 * depth;
  const double rest = path.Count > 0
    ? Rest * this->GetSurface(0).Tracer->GetSize(0) * (1.0 + 4.0 * depth / sight)
    : 0.0;
  const bool isRight = glm::length(vertex.Position - this->Frame - expected) <= rounding + rest &&
    std::fabs(vertex.Depth - depth) <= rounding + rest;
  if (!isRight)
  {
    this->Tally.Count(&RefractionTally::Wrong, i, "virtual vertex behind interfaces", path.Count);
  }
}

//------------------------------------------------------------------------------
// Point of a traced path that the depth convention of the virtual vertex gives; none if the ray
// ends before it.
std::optional<glm::dvec3> StackChecker::WalkBack(
  const TracedPath& path, const glm::dvec3& seen) const
{
  const glm::dvec3 sight = path.Points.front().Position - this->Eye;
  double rest =
    (glm::length(seen - this->Eye) - glm::length(sight)) / this->GetLayer(0).GetBefore();
  for (std::size_t k = 0; k < path.Points.size(); ++k)
  {
    const glm::dvec3& origin = path.Points[k].Position;
    const glm::dvec3& direction = path.Directions[k];
    const double along = rest * this->GetLayer(k).GetBehind();
    const bool isLast = k + 1 == path.Points.size();
    double length = std::numeric_limits<double>::infinity();
    if (!isLast)
    {
      length = glm::length(path.Points[k + 1].Position - origin);
    }
    else if (path.End != PathEnd::Passed)
    {
      const std::vector<PatchHit> hits = this->FindCrossings(k + 1, origin, direction);
      length = hits.empty() ? 0.0 : hits.front().Distance;
    }
    if (along >= 0.0 && along <= length)
    {
      return origin + along * direction;
    }
    rest -= length / this->GetLayer(k).GetBehind();
  }
  return std::nullopt;
}

//------------------------------------------------------------------------------
// The way back follows the sight ray to its first crossing. This is on another sheet than the image
// if one lies in front of it, if only by a millionth of a facet: small facets inside of others. The
// point is then the one that the ray through this crossing shows. Where several crossings are at
// one distance within rounding, each of them may be the first.
void StackChecker::CheckWayBack(
  int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex)
{
  if (path.Count == 0 || path.Count > this->Layers.size())
  {
    return;
  }
  const StackPlace& place = path.Points[0].Place;
  const glm::dvec3 sight = glm::normalize(path.Points[0].Ray.Origin - this->Eye);
  const TruePosition back =
    FindTruePosition(this->Solver.GetStack(), this->GetLayer(0).GetBefore(), vertex.Position);
  double error = std::numeric_limits<double>::infinity();
  double first = error;
  for (const PatchHit& hit : this->FindCrossings(0, this->Eye, sight))
  {
    const double cosine = -glm::dot(hit.Normal, sight);
    first = std::min(first, hit.Distance);
    if (hit.Distance > first + 8.0 * this->Rounding / cosine)
    {
      break;
    }
    const TracedPath traced = this->Trace(hit);
    const bool isImage = hit.Facet == place.Facet && glm::length(hit.B - place.B) < SamePlace;
    const std::optional<glm::dvec3> expected = isImage && traced.Points.size() >= path.Count
      ? std::optional<glm::dvec3>(point)
      : this->WalkBack(traced, vertex.Position - this->Frame);
    if (!traced.IsCertain || cosine < Marginal || !expected)
    {
      return;
    }
    error = std::min(error, glm::length(back.Position - this->Frame - *expected));
  }
  if (first == std::numeric_limits<double>::infinity())
  {
    return;
  }
  ++this->Tally.RoundTrips;
  const double scene = glm::length(point - this->Eye) + this->Test.Scale * Side;
  // A spread of rays multiplies the rest of the first sight point.
  this->Tally.LargestRoundTrip = std::max(this->Tally.LargestRoundTrip, error / scene);
  if (back.State != SeenState::Refracted || !(error <= RoundTrip * scene + 100.0 * this->Rounding))
  {
    this->Tally.Count(
      &RefractionTally::Wrong, i, "round trip is off, relative to the scene, by", error / scene);
  }
}

} // namespace meniscus::test
