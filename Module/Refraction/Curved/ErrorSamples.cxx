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
  PatchPoint at;
  if (!this->Exact.Meet(point, vertex, direction, at))
  {
    return { 0.0, SampleState::NoExactPoint };
  }
  const RefractionRay ray =
    ComputeRefractionRay(direction, at.Normal, this->Optics.Exterior / this->Optics.Interior);
  // A virtual vertex on the eye's side of the exact surface corresponds to no point behind it.
  const double apparent = glm::dot(vertex.Position - at.Position, direction);
  if (ray.Kind != RayKind::Refracted || apparent < 0.0)
  {
    return { 0.0, SampleState::NoExactPoint };
  }
  const double depth = apparent * this->Optics.Interior / this->Optics.Exterior;
  const double error = glm::length(at.Position + depth * ray.Direction - point);
  return std::isfinite(error) ? ErrorSample{ error, SampleState::Measured }
                              : ErrorSample{ 0.0, SampleState::NotFinite };
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
