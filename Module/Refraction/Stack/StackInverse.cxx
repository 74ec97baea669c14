// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackInverse.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

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

}
