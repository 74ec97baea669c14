// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackInverse.h"

#include "Refraction/Curved/CurveCrossings.h"
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

// Newton's method converges quadratically: the remaining error is of the order of the square of
// the last step, 1e-14 of a facet.
constexpr double LastStep = 1e-7;

}

//------------------------------------------------------------------------------
bool StackPatches::Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
  const glm::dvec3&, PatchPoint& at) const
{
  const RefractionStack::Link& next = this->Stack.GetLinks()[link];
  const glm::dvec3 from = origin - this->Stack.GetOrigin();
  SurfaceCrossing crossing;
  if (!this->Stack.FindNext(link, from, direction, crossing))
  {
    return false;
  }
  const CurvedPatch patch = next.Surface->GetPatch(crossing.Facet, !next.Passage.FromFront);
  // The direction is scaled, so that the parameter is about 1.
  const double scale = std::max(patch.GetSize(), crossing.Distance);
  double l = crossing.Distance / scale;
  glm::dvec2 b = crossing.B;
  glm::dvec3 normal;
  if (!MeetPatch(patch, { from - next.Shift, scale * direction }, LastStep, b, l, normal))
  {
    return false;
  }
  const double length = glm::length(normal);
  at.Position = origin + l * scale * direction;
  at.Normal = normal / length;
  // Written so that a NaN fails.
  return length > CurvedPatch::ShortestNormal && glm::dot(at.Normal, direction) < 0.0;
}

//------------------------------------------------------------------------------
StackTruePosition FindTruePosition(
  const RefractionStack& stack, double medium, const glm::dvec3& seen)
{
  const glm::dvec3 none(std::numeric_limits<double>::quiet_NaN());
  const glm::dvec3 eye = stack.GetEye() + stack.GetOrigin();
  const glm::dvec3 sight = seen - eye;
  const double distance = glm::length(sight);
  const std::vector<RefractionStack::Link>& links = stack.GetLinks();
  const double index = links.empty() ? medium : links.front().Passage.Before;
  if (!std::isfinite(distance) || distance == 0.0)
  {
    return { { seen, none, SeenState::NotFinite }, index * distance };
  }
  const StackPatches surfaces(stack);
  glm::dvec3 direction = sight / distance;
  PatchPoint at;
  if (links.empty() || !surfaces.Meet(0, eye, direction, eye, at) ||
    glm::dot(seen - at.Position, direction) <= 0.0)
  {
    return { { seen, none, SeenState::Unrefracted }, index * distance };
  }
  const glm::dvec3 first = at.Position;
  double optical = index * glm::length(first - eye);
  // Sum of the lengths of the legs to the point, each over the index of its medium.
  double rest = glm::dot(seen - first, direction) / index;
  for (std::size_t k = 0;; ++k)
  {
    const InterfacePassage& passage = links[k].Passage;
    const RefractionRay ray =
      ComputeRefractionRay(direction, at.Normal, passage.Before / passage.Behind);
    if (ray.Kind != RayKind::Refracted)
    {
      return { { seen, first, SeenState::TotallyReflected }, index * distance };
    }
    direction = ray.Direction;
    const glm::dvec3 origin = at.Position;
    const double toPoint = rest * passage.Behind;
    if (k + 1 < links.size() && !surfaces.Meet(k + 1, origin, direction, origin, at))
    {
      return { { seen, first, SeenState::Missed }, index * distance };
    }
    const double length = glm::length(at.Position - origin);
    if (k + 1 == links.size() || toPoint <= length)
    {
      return { { origin + toPoint * direction, first, SeenState::Refracted },
        optical + passage.Behind * toPoint };
    }
    rest -= length / passage.Behind;
    optical += passage.Behind * length;
  }
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
