// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/ErrorSamples.h"

#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meniscus
{
namespace
{

// A point whose barycentric coordinates in two cells are this close to a wall is in both. This
// tolerance reproduces the thesis's numbers of points (Documentation/refraction-measurements.md).
constexpr double Wall = 1e-7;

/** Two unit vectors that are normal to a unit vector and to each other. */
void MakeFrame(const glm::dvec3& axis, glm::dvec3 frame[2])
{
  const glm::dvec3 size = glm::abs(axis);
  const glm::dvec3 other = size.x <= size.y && size.x <= size.z
    ? glm::dvec3(1.0, 0.0, 0.0)
    : (size.y <= size.z ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0));
  frame[0] = glm::normalize(glm::cross(axis, other));
  frame[1] = glm::cross(axis, frame[0]);
}

/** Vector from the nearest place of a ray to a point. */
glm::dvec3 OffsetOf(const ExactRay& ray, const glm::dvec3& point)
{
  const glm::dvec3 to = point - ray.Origin;
  return to - glm::dot(to, ray.Direction) * ray.Direction;
}

}

//------------------------------------------------------------------------------
// The unknowns are the two tangents by which the direction is turned. Derivatives are differences,
// so that any exact surface will do.
double FindAngularError(const glm::dvec3& seen, const glm::dvec3& point, const ExactTrace& trace)
{
  // The square root of the rounding error balances both errors of a difference. Convergence is
  // linear with a factor of that size, so a last step of lastTurn leaves an error far below it.
  constexpr double difference = 1e-7;
  constexpr double lastTurn = 1e-11;
  constexpr int steps = 20;
  glm::dvec3 frame[2];
  MakeFrame(seen, frame);
  glm::dvec2 turn(0.0);
  const auto offset = [&](const glm::dvec2& at, ExactRay& ray)
  { return trace(glm::normalize(seen + at.x * frame[0] + at.y * frame[1]), ray); };
  for (int i = 0; i < steps; ++i)
  {
    ExactRay rays[3];
    if (!offset(turn, rays[0]) || !offset(turn + glm::dvec2(difference, 0.0), rays[1]) ||
      !offset(turn + glm::dvec2(0.0, difference), rays[2]))
    {
      break;
    }
    const glm::dvec3 at = OffsetOf(rays[0], point);
    const glm::dvec3 by[2] = { (OffsetOf(rays[1], point) - at) / difference,
      (OffsetOf(rays[2], point) - at) / difference };
    // Least squares: the offsets are three coordinates of two degrees of freedom.
    const double a = glm::dot(by[0], by[0]);
    const double b = glm::dot(by[0], by[1]);
    const double c = glm::dot(by[1], by[1]);
    const glm::dvec2 right(glm::dot(by[0], at), glm::dot(by[1], at));
    const double determinant = a * c - b * b;
    const glm::dvec2 step(
      (c * right.x - b * right.y) / determinant, (a * right.y - b * right.x) / determinant);
    turn -= step;
    const double length = glm::length(step);
    if (!std::isfinite(length))
    {
      break;
    }
    if (length <= lastTurn)
    {
      return std::atan(glm::length(turn));
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
const SightRaySearch& PatchesAsSurface::GetSearch() const
{
  std::call_once(
    this->HasSearch, [this]() { this->Search = std::make_unique<SightRaySearch>(this->Geometry); });
  return *this->Search;
}

//------------------------------------------------------------------------------
// The patch that shows the point is the patch that the ray meets, or a neighbour of it. Where the
// ray is nearly tangential, Newton's method from the sight point may diverge or end at a place that
// the ray meets from behind; then all patches are searched.
bool PatchesAsSurface::Meet(const glm::dvec3& point, const VirtualVertex& vertex,
  const glm::dvec3& direction, PatchPoint& at) const
{
  std::vector<VirtualVertex> images;
  if (this->Geometry.FindImages(point, images) != ImageState::Found)
  {
    return false;
  }
  const auto nearest = std::min_element(images.begin(), images.end(),
    [&vertex](const VirtualVertex& a, const VirtualVertex& b)
    {
      const glm::dvec3 first = a.SightPoint - vertex.SightPoint;
      const glm::dvec3 second = b.SightPoint - vertex.SightPoint;
      return glm::dot(first, first) < glm::dot(second, second);
    });
  return (this->Geometry.MeetRay(direction, *nearest, at) &&
           glm::dot(at.Normal, direction) < 0.0) ||
    this->GetSearch().Find(direction, nearest->SightPoint, at);
}

//------------------------------------------------------------------------------
ErrorSample ErrorSampler::Measure(const FlatMembraneSolver& geometry, const glm::dvec3& point) const
{
  const VirtualVertex vertex = geometry.SolvePoint(point);
  switch (vertex.State)
  {
    case ImageState::NotFinite:
      return { 0.0, SampleState::NotFinite };
    case ImageState::NoImage:
    case ImageState::NotAsked:
      return { 0.0, SampleState::NoImage };
    case ImageState::Found:
      break;
  }
  return geometry.HasOneCell(point, Wall) ? this->Compare(point, vertex)
                                          : ErrorSample{ 0.0, SampleState::SeveralImages };
}

//------------------------------------------------------------------------------
ErrorSample ErrorSampler::Measure(
  const CurvedMembraneSolver& geometry, const glm::dvec3& point) const
{
  std::vector<VirtualVertex> images;
  const ImageState state = geometry.FindImages(point, images);
  if (state != ImageState::Found)
  {
    return { 0.0, state == ImageState::NotFinite ? SampleState::NotFinite : SampleState::NoImage };
  }
  return images.size() == 1 ? this->Compare(point, images.front())
                            : ErrorSample{ 0.0, SampleState::SeveralImages };
}

//------------------------------------------------------------------------------
ErrorSample ErrorSampler::Compare(const glm::dvec3& point, const VirtualVertex& vertex) const
{
  const glm::dvec3 direction = glm::normalize(vertex.Position - this->Optics.Eye);
  ExactRay ray;
  // A virtual vertex on the eye's side of the exact surface corresponds to no point behind it.
  const bool refracted = this->Trace(point, vertex, direction, ray);
  const double apparent = glm::dot(vertex.Position - ray.Origin, direction);
  if (!refracted || apparent < 0.0)
  {
    return { 0.0, SampleState::NoExactPoint };
  }
  const double depth = apparent * this->Optics.Interior / this->Optics.Exterior;
  const double error = glm::length(ray.Origin + depth * ray.Direction - point);
  if (!std::isfinite(error))
  {
    return { 0.0, SampleState::NotFinite };
  }
  ErrorSample sample{ error, SampleState::Measured };
  if (this->Angles)
  {
    sample.Angle = FindAngularError(direction, point,
      [&](const glm::dvec3& along, ExactRay& behind)
      { return this->Trace(point, vertex, along, behind); });
  }
  return sample;
}

//------------------------------------------------------------------------------
bool ErrorSampler::Trace(const glm::dvec3& point, const VirtualVertex& vertex,
  const glm::dvec3& direction, ExactRay& behind) const
{
  PatchPoint at;
  if (!this->Exact.Meet(point, vertex, direction, at))
  {
    return false;
  }
  const RefractionRay ray =
    ComputeRefractionRay(direction, at.Normal, this->Optics.Exterior / this->Optics.Interior);
  behind = { at.Position, ray.Direction };
  return ray.Kind == RayKind::Refracted;
}

//------------------------------------------------------------------------------
ErrorSummary Summarize(const ErrorSample* samples, std::size_t count)
{
  ErrorSummary summary;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (samples[i].State == SampleState::Measured)
    {
      summary.Mean += samples[i].Error;
      summary.Largest = std::max(summary.Largest, samples[i].Error);
      ++summary.Count;
    }
  }
  if (summary.Count == 0)
  {
    return summary;
  }
  summary.Mean /= static_cast<double>(summary.Count);
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double away = samples[i].Error - summary.Mean;
    squares += samples[i].State == SampleState::Measured ? away * away : 0.0;
  }
  summary.Deviation = std::sqrt(squares / static_cast<double>(summary.Count));
  return summary;
}

}
