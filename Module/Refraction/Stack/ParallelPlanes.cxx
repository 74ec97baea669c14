// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/ParallelPlanes.h"

#include "Refraction/Membrane/HeightField.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace meniscus
{
namespace
{

// Normals and heights of planes in coordinates of single precision differ by this, relative to the
// size of the surface: a few units in the last place.
constexpr double LargestDeviation = 16.0 * std::numeric_limits<float>::epsilon();

// The same for coordinates of double precision.
constexpr double LargestRounding = 16.0 * std::numeric_limits<double>::epsilon();

// Joined vertices and those of facets without area are not used.
std::size_t GetFirstVertex(const Membrane& membrane)
{
  return static_cast<std::size_t>(membrane.GetFacets().front().front());
}

// Depth of a surface's plane along the axis, and the deviation from it in units of the surface's
// radius. Returns false if the surface is not a plane at right angles to the axis.
bool FindPlane(const RefractionStack::Link& link, const glm::dvec3& axis, const glm::dvec3& eye,
  double& depth, double& deviation)
{
  const Membrane& membrane = link.Surface->GetMembrane();
  const std::vector<glm::dvec3>& positions = membrane.GetPositions();
  const double side = link.Passage.FromFront ? -1.0 : 1.0;
  const glm::dvec3 origin = positions[GetFirstVertex(membrane)];
  depth = glm::dot(axis, origin + link.Shift - eye);
  deviation = 0.0;
  for (const Membrane::Facet& facet : membrane.GetFacets())
  {
    for (const std::int32_t vertex : facet)
    {
      const auto i = static_cast<std::size_t>(vertex);
      const glm::dvec3& normal = membrane.GetNormals()[i];
      const double height = std::fabs(glm::dot(axis, positions[i] - origin)) / membrane.GetRadius();
      const double lean = glm::length(glm::cross(axis, normal));
      // Written so that a NaN fails.
      if (!(height <= LargestDeviation) || !(lean <= LargestDeviation) ||
        !(side * glm::dot(axis, normal) > 0.0))
      {
        return false;
      }
      deviation = std::max({ deviation, height, lean });
    }
  }
  return depth > 0.0 &&
    IsConvexField(membrane, link.Surface->GetPatches(), HeightFrame(side * axis));
}

// Smallest index of refraction of the first `count` layers.
double FindLeastIndex(const std::vector<PlaneLayer>& layers, std::size_t count)
{
  double least = layers[0].Index;
  for (std::size_t i = 1; i < count; ++i)
  {
    least = std::min(least, layers[i].Index);
  }
  return least;
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
  const Membrane& membrane = first.Surface->GetMembrane();
  if (membrane.GetFacets().empty())
  {
    return;
  }
  this->Axis = (first.Passage.FromFront ? -1.0 : 1.0) *
    glm::normalize(membrane.GetNormals()[GetFirstVertex(membrane)]);
  this->Eye = stack.GetEye();
  this->Exact = true;
  this->Slack = 0.0;
  std::vector<PlaneLayer> layers{ { 0.0, 0.0, first.Passage.Before, 0.0 } };
  for (const RefractionStack::Link& link : stack.GetLinks())
  {
    double depth = 0.0;
    double deviation = 0.0;
    if (!FindPlane(link, this->Axis, this->Eye, depth, deviation) || depth <= layers.back().Begin)
    {
      return;
    }
    this->Exact = this->Exact && deviation <= LargestRounding;
    layers.back().End = depth;
    layers.push_back({ depth, std::numeric_limits<double>::infinity(), link.Passage.Behind, 0.0 });
    // The point may be as far from its plane; the coordinates of both are rounded.
    const RefractingSurface& surface = *link.Surface;
    this->Slack = std::max(this->Slack,
      2.0 * deviation * surface.GetMembrane().GetRadius() +
        surface.GetSlack(glm::length(stack.GetOrigin() + link.Shift)));
  }
  const double least = FindLeastIndex(layers, layers.size());
  for (PlaneLayer& layer : layers)
  {
    layer.Squared = layer.Index / least * (layer.Index / least);
  }
  this->Layers = layers;
}

//------------------------------------------------------------------------------
int ParallelPlanes::CountInFront(const glm::dvec3& point) const
{
  const double depth = glm::dot(this->Axis, point - this->Eye);
  int count = this->IsEmpty() ? -1 : 0;
  for (std::size_t i = 1; i < this->Layers.size(); ++i)
  {
    const double plane = this->Layers[i].Begin;
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
// The unknown is the tangent t of LateralSum.
glm::dvec3 ParallelPlanes::FindSight(
  const glm::dvec3& point, std::size_t count, const glm::dvec3& near) const
{
  const glm::dvec3 away = point - this->Eye;
  const double depth = glm::dot(this->Axis, away);
  const glm::dvec3 lateral = away - depth * this->Axis;
  const double distance = glm::length(lateral);
  const std::vector<PlaneLayer>& layers = this->Layers;
  const double least = FindLeastIndex(layers, count + 1);
  const double along = glm::dot(this->Axis, near);
  const double nearSine =
    layers[0].Index / least * glm::length(glm::cross(this->Axis, near)) / glm::length(near);
  const double straight = distance / depth;
  double t =
    along > 0.0 && nearSine < 1.0 ? nearSine / std::sqrt(1.0 - nearSine * nearSine) : straight;
  for (int tries = 0; tries < LateralSum::MostSteps; ++tries)
  {
    LateralSum sum;
    for (std::size_t i = 0; i <= count; ++i)
    {
      const double ratio = layers[i].Index / least;
      sum.Add((i < count ? layers[i].End : depth) - layers[i].Begin, ratio * ratio, t);
    }
    const double step = sum.GetStep(distance, t);
    t = std::max(t + step, straight);
    // Written so that a NaN ends the search.
    if (!(std::fabs(step) > LateralSum::LastStep * t))
    {
      break;
    }
  }
  const double sine = least / layers[0].Index * t / std::sqrt(1.0 + t * t);
  return distance > 0.0
    ? std::sqrt(std::max(1.0 - sine * sine, 0.0)) * this->Axis + (sine / distance) * lateral
    : this->Axis;
}

}
