// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/ParallelPlanes.h"

#include "Refraction/Tubes/RayTubeTree.h"

#include <glm/common.hpp>
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

// The first `count` layers, of which the last one has no end.
std::vector<PlaneLayer> MakeLayers(const std::vector<PlaneLayer>& all, std::size_t count)
{
  std::vector<PlaneLayer> layers(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  layers.back().End = std::numeric_limits<double>::infinity();
  double least = layers.front().Index;
  for (const PlaneLayer& layer : layers)
  {
    least = std::min(least, layer.Index);
  }
  for (PlaneLayer& layer : layers)
  {
    layer.Squared = layer.Index / least * (layer.Index / least);
  }
  return layers;
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
  this->Frame = HeightFrame((first.Passage.FromFront ? -1.0 : 1.0) *
    glm::normalize(membrane.GetNormals()[GetFirstVertex(membrane)]));
  this->Stack = &stack;
  this->Eye = stack.GetEye();
  this->Exact = true;
  this->Slack = 0.0;
  std::vector<PlaneLayer> layers{ { 0.0, 0.0, first.Passage.Before, 0.0 } };
  for (const RefractionStack::Link& link : stack.GetLinks())
  {
    double depth = 0.0;
    double deviation = 0.0;
    if (!FindPlane(link, this->GetAxis(), this->Eye, depth, deviation) ||
      depth <= layers.back().Begin)
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
  this->Inner.clear();
  for (std::size_t i = 0; i + 1 < layers.size(); ++i)
  {
    this->Inner.push_back(this->FindInner(stack.GetLinks()[i], layers[i]));
  }
  for (std::size_t count = 1; count <= layers.size(); ++count)
  {
    this->Layers.push_back(MakeLayers(layers, count));
  }
}

//------------------------------------------------------------------------------
// The rectangle about the vertices, or the part of it about its middle that is as wide as a square
// in a circle; an empty one if corners of both are not on the surface.
ParallelPlanes::Rectangle ParallelPlanes::FindInner(
  const RefractionStack::Link& link, const PlaneLayer& inFront) const
{
  const Membrane& membrane = link.Surface->GetMembrane();
  const glm::dvec3 foot = this->Eye + inFront.End * this->GetAxis() - link.Shift;
  Rectangle all{ glm::dvec2(std::numeric_limits<double>::infinity()),
    glm::dvec2(-std::numeric_limits<double>::infinity()) };
  for (const Membrane::Facet& facet : membrane.GetFacets())
  {
    for (const std::int32_t vertex : facet)
    {
      const glm::dvec2 place =
        this->Frame.Project(membrane.GetPositions()[static_cast<std::size_t>(vertex)] - foot);
      all = { glm::min(all.Low, place), glm::max(all.High, place) };
    }
  }
  const auto isOn = [&](double x, double y)
  {
    SurfaceCrossing crossing;
    const glm::dvec3 place = foot + x * this->Frame.First + y * this->Frame.Second;
    return link.FindCrossing(
      place - (inFront.End - inFront.Begin) * this->GetAxis(), this->GetAxis(), 0.0, crossing);
  };
  const glm::dvec2 middle = 0.5 * (all.Low + all.High);
  for (const double part : { 1.0, std::sqrt(0.5) })
  {
    const glm::dvec2 low = glm::mix(middle, all.Low, part);
    const glm::dvec2 high = glm::mix(middle, all.High, part);
    if (isOn(low.x, low.y) && isOn(high.x, low.y) && isOn(high.x, high.y) && isOn(low.x, high.y))
    {
      return { low, high };
    }
  }
  return { all.High, all.Low };
}

//------------------------------------------------------------------------------
bool ParallelPlanes::IsInReach(const glm::dvec3& point) const
{
  return RayTubeTree::IsInReach(
    point, this->Stack->GetLinks().front().Surface->GetMembrane().GetRadius());
}

//------------------------------------------------------------------------------
int ParallelPlanes::CountInFront(const glm::dvec3& point) const
{
  const double depth = glm::dot(this->GetAxis(), point - this->Eye);
  int count = this->IsEmpty() ? -1 : 0;
  for (std::size_t i = 1; i < this->Layers.size(); ++i)
  {
    const double plane = this->Layers.back()[i].Begin;
    // Written so that a NaN fails.
    if (!(std::fabs(depth - plane) > this->Slack))
    {
      return -1;
    }
    count += depth > plane ? 1 : 0;
  }
  return count;
}

//------------------------------------------------------------------------------
double ParallelPlanes::FindTangent(double depth, double straight, std::size_t count) const
{
  const std::vector<PlaneLayer>& layers = this->Layers[count];
  double t = straight;
  for (int tries = 0; tries < LateralSum::MostSteps; ++tries)
  {
    LateralSum sum;
    for (const PlaneLayer& layer : layers)
    {
      sum.Add(std::min(layer.End, depth) - layer.Begin, layer.Squared, t);
    }
    const double step = sum.GetStep(straight * depth, t);
    t = std::max(t + step, straight);
    // Written so that a NaN ends the search.
    if (!(std::fabs(step) > LateralSum::LastStep * t))
    {
      break;
    }
  }
  return t;
}

//------------------------------------------------------------------------------
glm::dvec3 ParallelPlanes::FindSight(const glm::dvec3& point, std::size_t count) const
{
  const glm::dvec3 away = point - this->Eye;
  const double depth = glm::dot(this->GetAxis(), away);
  const glm::dvec3 lateral = away - depth * this->GetAxis();
  const double distance = glm::length(lateral);
  const double t = this->FindTangent(depth, distance / depth, count);
  const double sine = t / std::sqrt(this->Layers[count][0].Squared * (1.0 + t * t));
  return distance > 0.0
    ? std::sqrt(std::max(1.0 - sine * sine, 0.0)) * this->GetAxis() + (sine / distance) * lateral
    : this->GetAxis();
}

//------------------------------------------------------------------------------
// The part of the direction along the planes is divided by the ratio of the indices. The other part
// follows from that: next to a critical angle, Snell's law for rounded directions loses it.
void ParallelPlanes::Refract(std::size_t plane, const glm::dvec3& direction, RayJet& ray) const
{
  const std::vector<PlaneLayer>& layers = this->GetLayers();
  const double ratio = layers[plane].Index / layers[plane + 1].Index;
  const glm::dvec3& axis = this->GetAxis();
  const VectorBy along = ratio * (ray.DirectionBy - axis * Dot(axis, ray.DirectionBy));
  const double inverse = 1.0 / glm::dot(axis, direction);
  ray.Direction = direction;
  ray.DirectionBy = along - axis * (inverse * Dot(direction, along));
}

//------------------------------------------------------------------------------
bool ParallelPlanes::FindPath(const glm::dvec3& point, std::size_t count, StackPath& path) const
{
  const glm::dvec3 away = point - this->Eye;
  const glm::dvec3& axis = this->GetAxis();
  const std::vector<PlaneLayer>& layers = this->Layers[count];
  const double depth = glm::dot(axis, away);
  const glm::dvec3 lateral = away - depth * axis;
  const double straight = glm::length(lateral) / depth;
  const glm::dvec3 side = straight > 0.0 ? glm::normalize(lateral) : glm::dvec3(0.0);
  const double t = this->FindTangent(depth, straight, count);
  // The ray in a layer, with a part of 1 along the axis.
  const auto getWay = [&axis, &layers, t, &side](std::size_t layer)
  { return axis + t * LateralSum::GetScale(layers[layer].Squared, t) * side; };
  path.Forget(this->Stack->GetLinks().size());
  path.Count = 0;
  RayJet ray;
  ray.Origin = this->Eye;
  for (std::size_t i = 0; i < count; ++i)
  {
    const RefractionStack::Link& link = this->Stack->GetLinks()[i];
    const double thickness = layers[i].End - layers[i].Begin;
    const glm::dvec3 way = getWay(i);
    const glm::dvec3 place = ray.Origin + thickness * way;
    SurfaceCrossing crossing;
    if (!link.FindCrossing(place - thickness * axis - link.Shift, axis, 0.0, crossing))
    {
      return false;
    }
    PathPoint& at = path.Points[i];
    at.Place = { crossing.Facet, crossing.B };
    at.Cosine = 1.0 / glm::length(way);
    PatchJet jet;
    link.Surface->GetPatch(crossing.Facet, !link.Passage.FromFront).Evaluate(crossing.B, jet);
    jet.Position = place;
    if (i == 0)
    {
      ray = MakeSightRay(this->Eye, jet);
      at.By = { NumberBy{ 1.0, 0.0 }, NumberBy{ 0.0, 1.0 } };
      path.Sight = ray.Direction;
      path.SightBy = ray.DirectionBy;
    }
    else
    {
      at.By = Transfer(ray, jet, GetPlaceGradient(jet, ray.Direction));
    }
    this->Refract(i, glm::normalize(getWay(i + 1)), ray);
    at.Ray = ray;
    path.Count = i + 1;
  }
  return true;
}

}
