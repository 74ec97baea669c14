// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackInverse.h"

#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace meniscus
{
namespace
{

const glm::dvec3 None(std::numeric_limits<double>::quiet_NaN());

}

//------------------------------------------------------------------------------
StackTruePosition FindTruePosition(
  const RefractionStack& stack, double medium, const glm::dvec3& seen)
{
  thread_local StackSightRay ray; // kept so that its memory is reused
  const glm::dvec3 eye = stack.GetEye() + stack.GetOrigin();
  const glm::dvec3 sight = seen - eye;
  const double distance = glm::length(sight);
  if (!std::isfinite(distance) || distance == 0.0)
  {
    return { { seen, None, SeenState::NotFinite }, medium * distance };
  }
  TraceSightRay(stack, medium, sight / distance, ray);
  std::size_t leg = 0;
  return WalkSightRay(ray, seen, leg);
}

//------------------------------------------------------------------------------
StackTruePosition FindTruePosition(
  SightRayTracer& tracer, const glm::dvec3& eye, const glm::dvec3& seen)
{
  return tracer.SetEye(eye) == EyeStatus::Ready
    ? FindTruePosition(tracer.GetStack(), tracer.GetMedium(), seen)
    : StackTruePosition{ { seen, None, SeenState::NotFinite },
        tracer.GetMedium() * glm::length(seen - eye) };
}

//------------------------------------------------------------------------------
StackTruePosition WalkSightRay(const StackSightRay& ray, const glm::dvec3& seen, std::size_t& leg)
{
  const SightLeg& sight = ray.Legs.front();
  const double distance = glm::length(seen - sight.Origin);
  leg = 0;
  const glm::dvec3 first =
    ray.Legs.size() > 1 ? ray.Legs[1].Origin : sight.Origin + sight.Length * sight.Direction;
  // Sum of the lengths of the legs behind the first surface up to the point, each divided by the
  // index of its medium. The share of each passed leg is subtracted.
  double rest = glm::dot(seen - first, sight.Direction) / sight.Index;
  if (!std::isfinite(sight.Length) || rest <= 0.0)
  {
    return { { seen, None, SeenState::Unrefracted }, sight.Index * distance };
  }
  double optical = sight.Index * sight.Length;
  for (leg = 1; leg < ray.Legs.size(); ++leg)
  {
    const SightLeg& on = ray.Legs[leg];
    if (leg + 1 == ray.Legs.size() && ray.End == PathEnd::Missed)
    {
      return { { seen, first, SeenState::Missed }, sight.Index * distance };
    }
    const double toPoint = rest * on.Index;
    if (toPoint <= on.Length)
    {
      return { { on.Origin + toPoint * on.Direction, first, SeenState::Refracted },
        optical + on.Index * toPoint };
    }
    rest -= on.Length / on.Index;
    optical += on.Index * on.Length;
  }
  --leg;
  return { { seen, first, SeenState::TotallyReflected }, sight.Index * distance };
}

//------------------------------------------------------------------------------
ErrorSample StackErrorSampler::Measure(const glm::dvec3& point) const
{
  thread_local std::vector<StackPath> images; // kept so that its memory is reused
  const ImageState state = this->Solver.FindImages(point, images);
  if (state != ImageState::Found)
  {
    return { 0.0, state == ImageState::NotFinite ? SampleState::NotFinite : SampleState::NoImage };
  }
  if (images.size() > 1)
  {
    return { 0.0, SampleState::SeveralImages };
  }
  const StackPath& path = images.front();
  return path.Count > 0 ? this->Compare(point, this->Solver.MakeVertex(point, path), path)
                        : ErrorSample{ 0.0, SampleState::NoImage };
}

//------------------------------------------------------------------------------
ErrorSample StackErrorSampler::Compare(
  const glm::dvec3& point, const StackVertex& vertex, const StackPath& path) const
{
  const RefractionStack& stack = this->Solver.GetStack();
  const ErrorSample notMet{ 0.0, SampleState::NoExactPoint };
  glm::dvec3 origin = stack.GetEye() + stack.GetOrigin();
  glm::dvec3 direction = glm::normalize(vertex.Position - origin);
  double rest = 0.0;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const InterfacePassage& passage = stack.GetLinks()[k].Passage;
    PatchPoint at;
    if (!this->Exact.Meet(k, origin, direction, path.Points[k].Ray.Origin + stack.GetOrigin(), at))
    {
      return notMet;
    }
    rest = k == 0 ? glm::dot(vertex.Position - at.Position, direction) / passage.Before
                  : rest - glm::length(at.Position - origin) / passage.Before;
    const RefractionRay ray =
      ComputeRefractionRay(direction, at.Normal, passage.Before / passage.Behind);
    if (ray.Kind != RayKind::Refracted)
    {
      return notMet;
    }
    origin = at.Position;
    direction = ray.Direction;
  }
  // A virtual vertex in front of the last exact surface corresponds to no point behind it.
  const double depth = rest * stack.GetLinks()[path.Count - 1].Passage.Behind;
  const double error = glm::length(origin + depth * direction - point);
  if (depth < 0.0)
  {
    return notMet;
  }
  return std::isfinite(error) ? ErrorSample{ error, SampleState::Measured }
                              : ErrorSample{ 0.0, SampleState::NotFinite };
}

}
