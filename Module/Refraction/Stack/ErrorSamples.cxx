// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/ErrorSamples.h"

#include "Refraction/Membrane/HeightField.h"
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

ErrorSample MakeWithoutImage(ImageState state)
{
  return { 0.0, state == ImageState::NotFinite ? SampleState::NotFinite : SampleState::NoImage };
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
  const HeightFrame frame(seen);
  glm::dvec2 turn(0.0);
  const auto offset = [&](const glm::dvec2& at, ExactRay& ray)
  { return trace(glm::normalize(seen + at.x * frame.First + at.y * frame.Second), ray); };
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
ErrorSample ErrorSampler::Measure(const FlatMembraneSolver& solver, const glm::dvec3& point) const
{
  const VirtualVertex vertex = solver.SolvePoint(point);
  if (vertex.State != ImageState::Found)
  {
    return MakeWithoutImage(vertex.State);
  }
  return solver.HasOneCell(point, Wall)
    ? this->Compare(point, vertex.Position, { vertex.SightPoint })
    : ErrorSample{ 0.0, SampleState::SeveralImages };
}

//------------------------------------------------------------------------------
ErrorSample ErrorSampler::Measure(const CurvedMembraneSolver& solver, const glm::dvec3& point) const
{
  thread_local std::vector<VirtualVertex> images; // kept so that its memory is reused
  const ImageState state = solver.FindImages(point, images);
  if (state != ImageState::Found)
  {
    return MakeWithoutImage(state);
  }
  return images.size() == 1 ? this->Compare(point, images[0].Position, { images[0].SightPoint })
                            : ErrorSample{ 0.0, SampleState::SeveralImages };
}

//------------------------------------------------------------------------------
ErrorSample ErrorSampler::Measure(const StackSolver& solver, const glm::dvec3& point) const
{
  thread_local std::vector<StackPath> images; // kept so that its memory is reused
  const ImageState state = solver.FindImages(point, images);
  if (state != ImageState::Found)
  {
    return MakeWithoutImage(state);
  }
  if (images.size() > 1)
  {
    return { 0.0, SampleState::SeveralImages };
  }
  const StackPath& path = images.front();
  if (path.Count == 0)
  {
    return MakeWithoutImage(ImageState::NoImage);
  }
  std::vector<glm::dvec3> sightPoints;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    sightPoints.push_back(path.Points[k].Ray.Origin + solver.GetStack().GetOrigin());
  }
  return this->Compare(point, solver.MakeVertex(point, path).Position, sightPoints);
}

//------------------------------------------------------------------------------
// The exact ray behind the interfaces of an image, which is seen by `sightPoints`. `first` is set
// to the point in which it meets the first of them, `between` to its length from there to the last
// one, each part divided by the index of refraction along it.
bool ErrorSampler::Trace(const std::vector<glm::dvec3>& sightPoints, const glm::dvec3& direction,
  ExactRay& behind, glm::dvec3& first, double& between) const
{
  behind = { this->Eye, direction };
  between = 0.0;
  for (std::size_t k = 0; k < sightPoints.size(); ++k)
  {
    const InterfacePassage& passage = this->Links[k].Passage;
    PatchPoint at;
    if (!this->Exact.Meet(k, behind.Origin, behind.Direction, sightPoints[k], at))
    {
      return false;
    }
    if (k == 0)
    {
      first = at.Position;
    }
    else
    {
      between += glm::length(at.Position - behind.Origin) / passage.Before;
    }
    const RefractionRay ray =
      ComputeRefractionRay(behind.Direction, at.Normal, passage.Before / passage.Behind);
    if (ray.Kind != RayKind::Refracted)
    {
      return false;
    }
    behind = { at.Position, ray.Direction };
  }
  return true;
}

//------------------------------------------------------------------------------
ErrorSample ErrorSampler::Compare(
  const glm::dvec3& point, const glm::dvec3& seen, const std::vector<glm::dvec3>& sightPoints) const
{
  const glm::dvec3 direction = glm::normalize(seen - this->Eye);
  ExactRay ray;
  glm::dvec3 first(0.0);
  double between = 0.0;
  if (!this->Trace(sightPoints, direction, ray, first, between))
  {
    return { 0.0, SampleState::NoExactPoint };
  }
  const double rest =
    glm::dot(seen - first, direction) / this->Links.front().Passage.Before - between;
  // A virtual vertex in front of the last exact surface corresponds to no point behind it.
  const double depth = rest * this->Links[sightPoints.size() - 1].Passage.Behind;
  if (depth < 0.0)
  {
    return { 0.0, SampleState::NoExactPoint };
  }
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
      { return this->Trace(sightPoints, along, behind, first, between); });
  }
  return sample;
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
