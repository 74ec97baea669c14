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
TruePosition FindTruePosition(const RefractionStack& stack, double medium, const glm::dvec3& seen,
  StackChain* chain, SeenDepth depth)
{
  thread_local StackSightRay ray; // kept so that its memory is reused
  const glm::dvec3 eye = stack.GetEye() + stack.GetOrigin();
  const glm::dvec3 sight = seen - eye;
  const double distance = glm::length(sight);
  if (!std::isfinite(distance) || distance == 0.0)
  {
    return { seen, None, SeenState::NotFinite, medium * distance };
  }
  TraceSightRay(stack, medium, sight / distance, ray, chain);
  std::size_t leg = 0;
  return WalkSightRay(ray, seen, leg, depth);
}

//------------------------------------------------------------------------------
TruePosition FindTruePosition(SightRayTracer& tracer, const glm::dvec3& eye, const glm::dvec3& seen,
  StackChain* chain, SeenDepth depth)
{
  return tracer.SetEye(eye) == EyeStatus::Ready
    ? FindTruePosition(tracer.GetStack(), tracer.GetMedium(), seen, chain, depth)
    : TruePosition{ seen, None, SeenState::NotFinite,
        tracer.GetMedium() * glm::length(seen - eye) };
}

//------------------------------------------------------------------------------
TruePosition WalkSightRay(
  const StackSightRay& ray, const glm::dvec3& seen, std::size_t& leg, SeenDepth depth)
{
  const SightLeg& sight = ray.Legs.front();
  const auto stay = [&seen, &sight](const glm::dvec3& sightPoint, SeenState state) -> TruePosition {
    return { seen, sightPoint, state, sight.Index * glm::length(seen - sight.Origin) };
  };
  leg = 0;
  const glm::dvec3 first =
    ray.Legs.size() > 1 ? ray.Legs[1].Origin : sight.Origin + sight.Length * sight.Direction;
  // Sum of the shares of the legs behind the first surface up to the point. The share of each
  // passed leg is subtracted.
  double rest = GetSeenLength(depth, glm::dot(seen - first, sight.Direction), sight.Index);
  if (!std::isfinite(sight.Length) || rest <= 0.0)
  {
    return stay(None, SeenState::Unrefracted);
  }
  double optical = sight.Index * sight.Length;
  for (leg = 1; leg < ray.Legs.size(); ++leg)
  {
    const SightLeg& on = ray.Legs[leg];
    if (leg + 1 == ray.Legs.size() && ray.End == PathEnd::Missed)
    {
      return stay(first, SeenState::Missed);
    }
    const double toPoint = GetTrueLength(depth, rest, on.Index);
    if (toPoint <= on.Length)
    {
      return { on.Origin + toPoint * on.Direction, first, SeenState::Refracted,
        optical + on.Index * toPoint };
    }
    rest -= GetSeenLength(depth, on.Length, on.Index);
    optical += on.Index * on.Length;
  }
  --leg;
  return stay(first, SeenState::TotallyReflected);
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
// The exact ray behind the interfaces of a path. `first` is set to the point in which it meets the
// first of them, `between` to its length from there to the last one, each part divided by the index
// of refraction along it.
bool StackErrorSampler::Trace(const StackPath& path, const glm::dvec3& direction, ExactRay& behind,
  glm::dvec3& first, double& between) const
{
  const RefractionStack& stack = this->Solver.GetStack();
  behind = { stack.GetEye() + stack.GetOrigin(), direction };
  between = 0.0;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const InterfacePassage& passage = stack.GetLinks()[k].Passage;
    const glm::dvec3 near = path.Points[k].Ray.Origin + stack.GetOrigin();
    PatchPoint at;
    if (!this->Exact.Meet(k, behind.Origin, behind.Direction, near, at))
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
ErrorSample StackErrorSampler::Compare(
  const glm::dvec3& point, const StackVertex& vertex, const StackPath& path) const
{
  const RefractionStack& stack = this->Solver.GetStack();
  const glm::dvec3 direction =
    glm::normalize(vertex.Position - (stack.GetEye() + stack.GetOrigin()));
  ExactRay ray;
  glm::dvec3 first(0.0);
  double between = 0.0;
  if (!this->Trace(path, direction, ray, first, between))
  {
    return { 0.0, SampleState::NoExactPoint };
  }
  const double rest =
    glm::dot(vertex.Position - first, direction) / stack.GetLinks()[0].Passage.Before - between;
  // A virtual vertex in front of the last exact surface corresponds to no point behind it.
  const double depth = rest * stack.GetLinks()[path.Count - 1].Passage.Behind;
  const double error = glm::length(ray.Origin + depth * ray.Direction - point);
  if (depth < 0.0)
  {
    return { 0.0, SampleState::NoExactPoint };
  }
  if (!std::isfinite(error))
  {
    return { 0.0, SampleState::NotFinite };
  }
  ErrorSample sample{ error, SampleState::Measured };
  if (this->Angles)
  {
    sample.Angle = FindAngularError(direction, point,
      [&](const glm::dvec3& along, ExactRay& behind)
      { return this->Trace(path, along, behind, first, between); });
  }
  return sample;
}

}
