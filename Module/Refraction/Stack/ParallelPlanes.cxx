// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/ParallelPlanes.h"

#include "Refraction/Membrane/HeightField.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Normals and heights of planes in coordinates of single precision differ by this, relative to the
// size of the surface: a few units in the last place.
constexpr double LargestDeviation = 16.0 * std::numeric_limits<float>::epsilon();

// Newton's method converges from one side and quadratically; it takes two to five steps. The second
// derivative of the lateral distance, times t, is less than three times the first: a step of this
// part of t leaves an error of less than 1.5e-14 t.
constexpr int NewtonSteps = 24;
constexpr double LastStep = 1e-7;

// Depth of a surface's plane along the axis. Returns false if it is not one at right angles to the
// axis.
bool FindPlane(
  const RefractionStack::Link& link, const glm::dvec3& axis, const glm::dvec3& eye, double& depth)
{
  const Membrane& membrane = link.Surface->GetMembrane();
  const std::vector<glm::dvec3>& positions = membrane.GetPositions();
  const double side = link.Passage.FromFront ? -1.0 : 1.0;
  depth = glm::dot(axis, positions[0] + link.Shift - eye);
  const double most = LargestDeviation * membrane.GetRadius();
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double height = glm::dot(axis, positions[i] - positions[0]);
    const glm::dvec3& normal = membrane.GetNormals()[i];
    // Written so that a NaN fails.
    if (!(std::fabs(height) <= most) ||
      !(glm::length(glm::cross(axis, normal)) <= LargestDeviation) ||
      !(side * glm::dot(axis, normal) > 0.0))
    {
      return false;
    }
  }
  return depth > 0.0 &&
    IsConvexField(membrane, link.Surface->GetPatches(), HeightFrame(side * axis));
}

}

//------------------------------------------------------------------------------
void ParallelPlanes::Set(const RefractionStack& stack)
{
  this->Clear();
  if (stack.GetLinks().empty())
  {
    return;
  }
  const RefractionStack::Link& first = stack.GetLinks().front();
  const std::vector<glm::dvec3>& normals = first.Surface->GetMembrane().GetNormals();
  if (normals.empty())
  {
    return;
  }
  this->Axis = (first.Passage.FromFront ? -1.0 : 1.0) * glm::normalize(normals.front());
  this->Eye = stack.GetEye();
  this->Indices = { first.Passage.Before };
  this->Slack = 0.0;
  std::vector<double> depths;
  for (const RefractionStack::Link& link : stack.GetLinks())
  {
    double depth = 0.0;
    if (!FindPlane(link, this->Axis, this->Eye, depth) ||
      (!depths.empty() && depth <= depths.back()))
    {
      return;
    }
    depths.push_back(depth);
    this->Indices.push_back(link.Passage.Behind);
    this->Slack =
      std::max(this->Slack, 2.0 * LargestDeviation * link.Surface->GetMembrane().GetRadius());
  }
  this->Depths = depths;
}

//------------------------------------------------------------------------------
int ParallelPlanes::CountInFront(const glm::dvec3& point) const
{
  const double depth = glm::dot(this->Axis, point - this->Eye);
  int count = this->IsEmpty() ? -1 : 0;
  for (const double plane : this->Depths)
  {
    // Written so that a NaN fails.
    if (!(std::fabs(depth - plane) > this->Slack))
    {
      return -1;
    }
    count += depth > plane ? 1 : 0;
  }
  return depth > 0.0 ? count : -1;
}

//------------------------------------------------------------------------------
// The unknown is the tangent t in the layer of the smallest index m: those in the others,
// t / sqrt(r^2 + (r^2 - 1) t^2) with r = n / m, are concave in t, and so is the lateral distance.
// Newton's method comes from below after the first step. The straight way has the least tangent.
glm::dvec3 ParallelPlanes::FindSight(
  const glm::dvec3& point, std::size_t count, const glm::dvec3& near) const
{
  const glm::dvec3 away = point - this->Eye;
  const double depth = glm::dot(this->Axis, away);
  const glm::dvec3 lateral = away - depth * this->Axis;
  const double distance = glm::length(lateral);
  const double least =
    *std::min_element(this->Indices.begin(), this->Indices.begin() + static_cast<int>(count) + 1);
  const double along = glm::dot(this->Axis, near);
  const double nearSine =
    this->Indices[0] / least * glm::length(glm::cross(this->Axis, near)) / glm::length(near);
  const double straight = distance / depth;
  double t =
    along > 0.0 && nearSine < 1.0 ? nearSine / std::sqrt(1.0 - nearSine * nearSine) : straight;
  for (int i = 0; i < NewtonSteps; ++i)
  {
    double reached = 0.0; // over t
    double slope = 0.0;
    double before = 0.0;
    for (std::size_t layer = 0; layer <= count; ++layer)
    {
      const double end = layer < count ? this->Depths[layer] : depth;
      const double ratio = this->Indices[layer] / least;
      const double squared = ratio * ratio;
      const double scale = 1.0 / std::sqrt(squared + (squared - 1.0) * t * t);
      const double part = (end - before) * scale;
      reached += part;
      slope += part * squared * scale * scale;
      before = end;
    }
    const double step = (distance - reached * t) / slope;
    t = std::max(t + step, straight);
    // Written so that a NaN ends the search.
    if (!(std::fabs(step) > LastStep * t))
    {
      break;
    }
  }
  const double sine = least / this->Indices[0] * t / std::sqrt(1.0 + t * t);
  return distance > 0.0
    ? std::sqrt(std::max(1.0 - sine * sine, 0.0)) * this->Axis + (sine / distance) * lateral
    : this->Axis;
}

}
