// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractedRays.h"

#include <algorithm>
#include <cmath>

namespace meniscus::reference
{

namespace
{

Vector3 MakeSum(const Vector3& a, double factor, const Vector3& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

Vector3 MakeUnit(const Vector3& a)
{
  return MakeSum({ 0.0, 0.0, 0.0 }, 1.0 / std::sqrt(Dot(a, a)), a);
}

Ray WithUnitDirection(const Ray& ray)
{
  const double length = std::sqrt(Dot(ray.Direction, ray.Direction));
  return { ray.Origin, MakeUnit(ray.Direction), ray.Begin * length, ray.End * length };
}

double Bisect(const std::function<double(double)>& f, double low, double high)
{
  const bool rises = f(low) < 0.0;
  for (;;)
  {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high)
    {
      return middle;
    }
    ((f(middle) < 0.0) == rises ? low : high) = middle;
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
RefractingSurface MakePlane(const Vector3& origin, const Vector3& normal)
{
  RefractingSurface surface;
  surface.Normal = [normal](const Vector3&) { return MakeUnit(normal); };
  surface.Meet = [origin, normal](const Ray& ray) -> std::vector<double>
  {
    const double along = Dot(normal, ray.Direction);
    return along != 0.0
      ? std::vector<double>{ Dot(normal, MakeSum(origin, -1.0, ray.Origin)) / along }
      : std::vector<double>{};
  };
  return surface;
}

//------------------------------------------------------------------------------
RefractingSurface MakeSphere(const Vector3& center, double radius)
{
  RefractingSurface surface;
  surface.Normal = [center](const Vector3& x) { return MakeUnit(MakeSum(x, -1.0, center)); };
  surface.Meet = [center, radius](const Ray& ray) -> std::vector<double>
  {
    const Vector3 toCenter = MakeSum(center, -1.0, ray.Origin);
    const double along = Dot(toCenter, ray.Direction);
    const Vector3 across = MakeSum(toCenter, -along, ray.Direction);
    const double squared = radius * radius - Dot(across, across);
    if (squared < 0.0)
    {
      return {};
    }
    return { along - std::sqrt(squared), along + std::sqrt(squared) };
  };
  return surface;
}

//------------------------------------------------------------------------------
RefractingSurface MakeWaves(double level, double amplitude, double k)
{
  RefractingSurface surface;
  surface.Normal = [amplitude, k](const Vector3& x)
  {
    return MakeUnit({ -amplitude * k * std::cos(k * x[0]) * std::sin(k * x[2]), 1.0,
      -amplitude * k * std::sin(k * x[0]) * std::cos(k * x[2]) });
  };
  surface.Meet = [level, amplitude, k](const Ray& ray) -> std::vector<double>
  {
    const auto above = [&](double t)
    {
      const Vector3 x = MakeSum(ray.Origin, t, ray.Direction);
      return x[1] - level - amplitude * std::sin(k * x[0]) * std::sin(k * x[2]);
    };
    // Inside the slab of the waves, by steps of 1 / 128 of a wave.
    const double a = (level + amplitude - ray.Origin[1]) / ray.Direction[1];
    const double b = (level - amplitude - ray.Origin[1]) / ray.Direction[1];
    const double first = std::min(a, b);
    const double last = std::max(a, b);
    const int steps = 2 + static_cast<int>((last - first) * k * 128.0 / 6.283185307179586);
    std::vector<double> found;
    for (int i = 0; i < steps; ++i)
    {
      const double from = first + (last - first) * i / steps;
      const double to = first + (last - first) * (i + 1) / steps;
      if ((above(from) < 0.0) != (above(to) < 0.0))
      {
        found.push_back(Bisect(above, from, to));
      }
    }
    return found;
  };
  return surface;
}

//------------------------------------------------------------------------------
RefractedRay Refract(
  const RefractingSurface& surface, const Ray& given, double eye, bool endsOpaque)
{
  const Ray ray = WithUnitDirection(given);
  eye *= std::sqrt(Dot(given.Direction, given.Direction));
  RefractedRay result{ ray, Ray() };
  double sight = HUGE_VAL;
  for (const double at : surface.Meet(ray))
  {
    if (at > eye && surface.Has(MakeSum(ray.Origin, at, ray.Direction)))
    {
      sight = std::min(sight, at);
    }
  }
  if (sight == HUGE_VAL)
  {
    return result;
  }
  result.Straight.End = std::min(ray.End, sight);
  const Vector3 place = MakeSum(ray.Origin, sight, ray.Direction);
  Vector3 normal = surface.Normal(place);
  double from = surface.Exterior;
  double to = surface.Interior;
  if (Dot(normal, ray.Direction) > 0.0)
  {
    normal = MakeSum({ 0.0, 0.0, 0.0 }, -1.0, normal);
    std::swap(from, to);
  }
  const Vector3 tangent = MakeSum(ray.Direction, -Dot(ray.Direction, normal), normal);
  const double sineIn = std::sqrt(Dot(tangent, tangent));
  const double sineOut = sineIn * from / to;
  if (sineOut >= 1.0)
  {
    return result;
  }
  const double cosineOut = std::sqrt((1.0 - sineOut) * (1.0 + sineOut));
  const double part = sineIn > 0.0 ? sineOut / sineIn : 0.0;
  result.Bent.Origin = place;
  result.Bent.Direction =
    MakeUnit(MakeSum(MakeSum({ 0.0, 0.0, 0.0 }, part, tangent), -cosineOut, normal));
  result.Bent.Begin = std::max(0.0, ray.Begin - sight) * to / from;
  result.Bent.End = endsOpaque ? (ray.End - sight) * to / from : 1e6;
  return result;
}

//------------------------------------------------------------------------------
std::vector<RaySegment> FindSegments(
  const ReferenceRayIntegrator& integrator, const RefractedRay& ray)
{
  std::vector<RaySegment> all;
  std::vector<RaySegment> segments;
  if (ray.Straight.Begin < ray.Straight.End)
  {
    integrator.FindSegments(ray.Straight, all);
  }
  if (ray.Bent.Begin < ray.Bent.End)
  {
    integrator.FindSegments(ray.Bent, segments);
    for (RaySegment& segment : segments)
    {
      segment.Begin += ray.Straight.End;
      segment.End += ray.Straight.End;
    }
    all.insert(all.end(), segments.begin(), segments.end());
  }
  return all;
}

//------------------------------------------------------------------------------
std::array<double, 4> Compose(
  const RefractedRay& ray, const std::function<std::array<double, 4>(const Ray&)>& trace)
{
  std::array<double, 4> total{ 0.0, 0.0, 0.0, 0.0 };
  for (const Ray* part : { &ray.Straight, &ray.Bent })
  {
    if (part->Begin < part->End)
    {
      const std::array<double, 4> behind = trace(*part);
      const double left = 1.0 - total[3];
      for (std::size_t c = 0; c < 4; ++c)
      {
        total[c] += left * behind[c];
      }
    }
  }
  return total;
}

} // namespace meniscus::reference
