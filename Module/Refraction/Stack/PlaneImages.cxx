// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/PlaneImages.h"

#include "Refraction/Surface/PatchCrossings.h"
#include "Simd/LaneLoop.h"

#include <glm/geometric.hpp>

namespace meniscus
{
namespace
{

// Facets to cross from one sight point to the next. For longer ways the tree is faster.
constexpr int LongestFacetWay = 16;

}

//------------------------------------------------------------------------------
bool PlaneImages::Add(const glm::dvec3& point, std::size_t number)
{
  const glm::dvec3 local = point - this->Stack.GetOrigin();
  const auto planes = static_cast<int>(this->Planes.GetLayers().size()) - 1;
  if (this->Planes.CountInFront(local) != planes)
  {
    return false;
  }
  const int lane = this->Lanes.Count++;
  const glm::dvec3 away = local - this->Stack.GetEye();
  const double depth = glm::dot(this->Planes.GetAxis(), away);
  const glm::dvec3 lateral = away - depth * this->Planes.GetAxis();
  const double distance = glm::length(lateral);
  this->Lanes.Depth[lane] = depth;
  this->Lanes.Distance[lane] = distance;
  this->Lateral[lane] = (distance > 0.0 ? 1.0 / distance : 0.0) * lateral;
  this->Numbers[lane] = number;
  this->IsMissed[lane] = false;
  this->Transmittance[lane] = PlateTransmittance();
  return true;
}

//------------------------------------------------------------------------------
void PlaneImages::Solve(const ImageOutput& output)
{
  const int count = this->Lanes.Count;
  if (count == 0)
  {
    return;
  }
  // The last point fills the last group of lanes.
  for (int lane = count; lane % LaneGroup != 0; ++lane)
  {
    this->Lanes.Depth[lane] = this->Lanes.Depth[count - 1];
    this->Lanes.Distance[lane] = this->Lanes.Distance[count - 1];
  }
  const std::vector<PlaneLayer>& layers = this->Planes.GetLayers();
  this->Lanes.FindTangents(layers, this->Planes.GetInstructionSet());
  this->Lanes.Pass(layers, 0, this->Planes.GetInstructionSet());
  for (std::size_t plane = 0; plane + 1 < layers.size(); ++plane)
  {
    this->MeetPlane(plane, output);
    this->Lanes.Pass(layers, plane + 1, this->Planes.GetInstructionSet());
    this->WriteLegs(plane, output);
  }
  this->WriteVertices(output);
}

//------------------------------------------------------------------------------
void PlaneImages::MeetPlane(std::size_t plane, const ImageOutput& output)
{
  const glm::dvec3 foot =
    this->Stack.GetEye() + this->Planes.GetLayers()[plane].End * this->Planes.GetAxis();
  const std::vector<PlaneLayer>& layers = this->Planes.GetLayers();
  Facet facet; // kept from point to point
  for (int lane = 0; lane < this->Lanes.Count; ++lane)
  {
    const glm::dvec3 place = foot + this->Lanes.Side[lane] * this->Lateral[lane];
    this->IsMissed[lane] = this->IsMissed[lane] || !this->FindFacet(plane, place, facet);
    output.Details[this->Numbers[lane]].LastSightPoint = place + this->Stack.GetOrigin();
    this->Transmittance[lane].Add(
      this->Lanes.Cosine[lane], layers[plane].Index, layers[plane + 1].Index);
    if (plane == 0)
    {
      this->SightPoint[lane] = place;
      this->FirstFacet[lane] = facet.Number;
    }
  }
}

//------------------------------------------------------------------------------
bool PlaneImages::FindFacet(std::size_t plane, const glm::dvec3& place, Facet& facet) const
{
  const RefractionStack::Link& link = this->Stack.GetLinks()[plane];
  const CurvedPatches& patches = link.Surface->GetPatches();
  const glm::dvec3 local = place - link.Shift;
  if (facet.Number != CurvedPatches::NoFacet && GoToFacet(patches, local, facet))
  {
    return true;
  }
  const PlaneLayer& layer = this->Planes.GetLayers()[plane];
  const glm::dvec3& axis = this->Planes.GetAxis();
  SurfaceCrossing crossing;
  if (!link.FindCrossing(local - (layer.End - layer.Begin) * axis, axis, 0.0, crossing))
  {
    return false;
  }
  facet.Set(patches, crossing.Facet);
  return facet.FindOutside(local).Least >= -PatchCrossings::Border;
}

//------------------------------------------------------------------------------
// Crosses the edge beyond which the place is farthest, until a facet contains it.
bool PlaneImages::GoToFacet(const CurvedPatches& patches, const glm::dvec3& place, Facet& facet)
{
  for (int step = 0; step < LongestFacetWay; ++step)
  {
    const Outside outside = facet.FindOutside(place);
    if (outside.Least >= -PatchCrossings::Border)
    {
      return true;
    }
    const std::int32_t next = patches.GetNeighbour(facet.Number, outside.Corner);
    if (next == CurvedPatches::NoFacet)
    {
      return false;
    }
    facet.Set(patches, next);
  }
  return false;
}

//------------------------------------------------------------------------------
void PlaneImages::Facet::Set(const CurvedPatches& patches, std::int32_t facet)
{
  const CurvedPatch patch = patches.GetPatch(facet);
  const glm::dvec3 u = patch.Corner[1] - patch.Corner[0];
  const glm::dvec3 v = patch.Corner[2] - patch.Corner[0];
  const glm::dvec3 normal = glm::cross(u, v);
  const double inverse = 1.0 / glm::dot(normal, normal);
  this->Number = facet;
  this->Corner = patch.Corner[0];
  this->Gradient = { inverse * glm::cross(v, normal), inverse * glm::cross(normal, u) };
}

//------------------------------------------------------------------------------
// Writes the lengths of the legs behind a plane.
void PlaneImages::WriteLegs(std::size_t plane, const ImageOutput& output) const
{
  // Interfaces behind the eye come first.
  const std::size_t behindEye = output.LegsPerPoint - this->Stack.GetLinks().size();
  for (int lane = 0; lane < this->Lanes.Count; ++lane)
  {
    double* const legs = output.Legs + output.LegsPerPoint * this->Numbers[lane];
    std::fill(legs, legs + (plane == 0 ? behindEye : 0), 0.0);
    legs[behindEye + plane] = this->Lanes.Length[lane];
  }
}

//------------------------------------------------------------------------------
void PlaneImages::WriteVertices(const ImageOutput& output) const
{
  const glm::dvec3& origin = this->Stack.GetOrigin();
  const PlaneLayer& first = this->Planes.GetLayers().front();
  for (int lane = 0; lane < this->Lanes.Count; ++lane)
  {
    const glm::dvec3& place = this->SightPoint[lane];
    // Eq. 2.4 over the length of the sight ray.
    const double behind =
      first.Index * this->Lanes.Optical[lane] * this->Lanes.FirstCosine[lane] / first.End;
    VirtualVertex vertex;
    vertex.Position = place + behind * (place - this->Stack.GetEye()) + origin;
    vertex.SightPoint = place + origin;
    vertex.Depth = this->Lanes.Geometric[lane];
    vertex.Reflectance = this->Lanes.Reflectance[lane];
    vertex.Cosine = this->Lanes.FirstCosine[lane];
    vertex.Facet = this->FirstFacet[lane];
    vertex.State = ImageState::Found;
    output.Vertices[this->Numbers[lane]] = vertex;
    StackDetail& detail = output.Details[this->Numbers[lane]];
    detail.Transmittance = this->Transmittance[lane].Get();
    detail.Passed = static_cast<std::int32_t>(this->Stack.GetLinks().size());
  }
}

}
