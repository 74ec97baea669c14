// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/PlaneImages.h"

#include "Refraction/Membrane/CrossProduct.h"
#include "Refraction/Stack/StackShot.h"
#include "Refraction/Surface/PatchCrossings.h"
#include "Simd/LaneLoop.h"

#include <glm/geometric.hpp>

namespace meniscus
{
namespace
{

// Facets to cross from one sight point to the next. For longer ways the tree is faster.
constexpr std::size_t LongestFacetWay = 16;

}

//------------------------------------------------------------------------------
/** Sets the distance from the axis, and the direction away from it. */
struct PlaneImages::BeginKernel
{
  void operator()(PlaceLanes& lanes, int i) const
  {
    const double x = lanes.Across[0][i];
    const double y = lanes.Across[1][i];
    const double distance = std::sqrt(x * x + y * y);
    lanes.Distance[i] = distance;
    lanes.Across[0][i] = x / (distance > 0.0 ? distance : 1.0);
    lanes.Across[1][i] = y / (distance > 0.0 ? distance : 1.0);
  }
};

/** Sets the places on the plane behind the layer that was passed last. */
struct PlaneImages::PlaceKernel
{
  void operator()(PlaceLanes& lanes, int i) const
  {
    lanes.Last[0][i] = lanes.Side[i] * lanes.Across[0][i];
    lanes.Last[1][i] = lanes.Side[i] * lanes.Across[1][i];
  }
};

//------------------------------------------------------------------------------
bool PlaneImages::Add(const glm::dvec3& point, std::size_t number)
{
  const HeightFrame& frame = this->Planes.GetFrame();
  const glm::dvec3 local = point - this->Stack.GetOrigin();
  const glm::dvec3 away = local - this->Stack.GetEye();
  const double depth = frame.GetHeight(away);
  if (!this->Planes.IsBehindAll(depth) || !this->Planes.IsInReach(local))
  {
    return false;
  }
  const int lane = this->Lanes.Count++;
  const glm::dvec2 across = frame.Project(away);
  this->Lanes.Depth[lane] = depth;
  this->Lanes.Across[0][lane] = across.x;
  this->Lanes.Across[1][lane] = across.y;
  this->Numbers[lane] = number;
  this->Points[lane] = point;
  this->Meetings[lane] = Meeting::Inside;
  return true;
}

//------------------------------------------------------------------------------
void PlaneImages::Solve(const ImageOutput& output, std::vector<std::size_t>& others)
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
    this->Lanes.Across[0][lane] = this->Lanes.Across[0][count - 1];
    this->Lanes.Across[1][lane] = this->Lanes.Across[1][count - 1];
  }
  const std::vector<PlaneLayer>& layers = this->Planes.GetLayers();
  const InstructionSet set = this->Planes.GetInstructionSet();
  RunLanes(BeginKernel{}, set, this->Lanes);
  this->Lanes.FindTangents(layers, set);
  this->Lanes.Pass(layers, 0, set);
  for (std::size_t plane = 0; plane + 1 < layers.size(); ++plane)
  {
    RunLanes(PlaceKernel{}, set, this->Lanes);
    if (plane == 0 || !this->AreAllInside(plane))
    {
      this->FindFacets(plane);
    }
    this->Lanes.Pass(layers, plane + 1, set);
    this->WriteLegs(plane, output);
  }
  this->WriteVertices(output);
  for (int lane = 0; lane < count; ++lane)
  {
    if (this->Meetings[lane] != Meeting::Inside)
    {
      this->WriteWithout(lane, output, others);
    }
  }
  this->Lanes.Count = 0;
}

//------------------------------------------------------------------------------
// Foot of the eye on a plane, relative to the origin of its surface.
glm::dvec3 PlaneImages::GetFoot(std::size_t plane) const
{
  return this->Stack.GetEye() + this->Planes.GetLayers()[plane].End * this->Planes.GetAxis() -
    this->Stack.GetLinks()[plane].Shift;
}

//------------------------------------------------------------------------------
// True if all places are inside of the outline, which is convex: it contains a box around them if
// it contains the corners.
bool PlaneImages::AreAllInside(std::size_t plane) const
{
  glm::dvec2 low;
  glm::dvec2 high;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double* const places = this->Lanes.Last[axis];
    const auto ends = std::minmax_element(places, places + this->Lanes.Count);
    low[axis] = *ends.first;
    high[axis] = *ends.second;
  }
  if (this->Planes.IsInside(plane, low, high))
  {
    return true;
  }
  Facet facet;
  return this->FindFacet(plane, low, facet) == Meeting::Inside &&
    this->FindFacet(plane, { high.x, low.y }, facet) == Meeting::Inside &&
    this->FindFacet(plane, high, facet) == Meeting::Inside &&
    this->FindFacet(plane, { low.x, high.y }, facet) == Meeting::Inside;
}

//------------------------------------------------------------------------------
// Finds the facets of a plane that contain the places of all rays so far inside.
void PlaneImages::FindFacets(std::size_t plane)
{
  Facet facet; // kept from point to point
  for (int lane = 0; lane < this->Lanes.Count; ++lane)
  {
    const glm::dvec2 place(this->Lanes.Last[0][lane], this->Lanes.Last[1][lane]);
    if (this->Meetings[lane] == Meeting::Inside)
    {
      this->Meetings[lane] = this->FindFacet(plane, place, facet);
    }
    if (plane == 0)
    {
      this->Lanes.First[0][lane] = place.x;
      this->Lanes.First[1][lane] = place.y;
      this->FirstFacet[lane] = facet.Number;
    }
  }
}

//------------------------------------------------------------------------------
PlaneImages::Meeting PlaneImages::FindFacet(
  std::size_t plane, const glm::dvec2& place, Facet& facet) const
{
  if (facet.Number != CurvedPatches::NoFacet)
  {
    const Meeting meeting = this->GoToFacet(plane, place, LongestFacetWay, facet);
    if (meeting != Meeting::Open)
    {
      return meeting;
    }
  }
  const RefractionStack::Link& link = this->Stack.GetLinks()[plane];
  const PlaneLayer& layer = this->Planes.GetLayers()[plane];
  const HeightFrame& frame = this->Planes.GetFrame();
  const glm::dvec3 local = this->GetFoot(plane) + place.x * frame.First + place.y * frame.Second;
  SurfaceCrossing crossing;
  if (link.FindCrossing(local - (layer.End - layer.Begin) * frame.Axis, frame.Axis, 0.0, crossing))
  {
    facet = this->MakeFacet(plane, crossing.Facet);
    return facet.FindOutside(place).Least >= -PatchCrossings::Border ? Meeting::Inside
                                                                     : Meeting::Open;
  }
  // From any facet to the border: each of them is passed once at most, if the way is no circle.
  facet = this->MakeFacet(plane, 0);
  const std::size_t facets = link.Surface->GetMembrane().GetFacets().size();
  const Meeting meeting = this->GoToFacet(plane, place, facets, facet);
  return meeting == Meeting::Inside ? Meeting::Open : meeting;
}

//------------------------------------------------------------------------------
// Crosses the edge beyond which the place is farthest, until a facet contains it, or until it is
// beyond a border. At most `most` facets are passed.
PlaneImages::Meeting PlaneImages::GoToFacet(
  std::size_t plane, const glm::dvec2& place, std::size_t most, Facet& facet) const
{
  const CurvedPatches& patches = this->Stack.GetLinks()[plane].Surface->GetPatches();
  for (std::size_t step = 0; step < most; ++step)
  {
    const Outside outside = facet.FindOutside(place);
    if (outside.Least >= -PatchCrossings::Border)
    {
      return Meeting::Inside;
    }
    const std::int32_t next = patches.GetNeighbour(facet.Number, outside.Corner);
    if (next == CurvedPatches::NoFacet)
    {
      return this->IsBeyond(plane, place, facet, outside) ? Meeting::Outside : Meeting::Open;
    }
    facet = this->MakeFacet(plane, next);
  }
  return Meeting::Open;
}

//------------------------------------------------------------------------------
// True if a place is beyond a border edge, and so beyond the convex outline, by more than rounding:
// of the place, and of the outline's turns. A turn by the slack over the length of an edge at each
// of n edges on the way to the place adds up to n^2 times the slack there.
bool PlaneImages::IsBeyond(
  std::size_t plane, const glm::dvec2& place, const Facet& facet, const Outside& outside) const
{
  const auto corner = static_cast<std::size_t>(outside.Corner);
  const glm::dvec2& begin = facet.Corners[(corner + 1) % 3];
  const double length = glm::length(facet.Corners[(corner + 2) % 3] - begin);
  const double edges = 1.0 + glm::length(place - begin) / length;
  const glm::dvec2 byPlace =
    corner == 0 ? facet.ByPlace[0] + facet.ByPlace[1] : facet.ByPlace[corner - 1];
  const double slack = this->Stack.GetLinks()[plane].Surface->GetSlack(
    glm::length(place) + glm::length(this->GetFoot(plane)));
  return -outside.Least > edges * edges * slack * glm::length(byPlace);
}

//------------------------------------------------------------------------------
PlaneImages::Facet PlaneImages::MakeFacet(std::size_t plane, std::int32_t number) const
{
  const Membrane& membrane = this->Stack.GetLinks()[plane].Surface->GetMembrane();
  const glm::dvec3 foot = this->GetFoot(plane);
  Facet facet;
  facet.Number = number;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::int32_t vertex = membrane.GetFacets()[static_cast<std::size_t>(number)][k];
    facet.Corners[k] = this->Planes.GetFrame().Project(
      membrane.GetPositions()[static_cast<std::size_t>(vertex)] - foot);
  }
  const glm::dvec2 u = facet.Corners[1] - facet.Corners[0];
  const glm::dvec2 v = facet.Corners[2] - facet.Corners[0];
  const double inverse = 1.0 / Cross(u, v);
  facet.ByPlace[0] = inverse * glm::dvec2(v.y, -v.x);
  facet.ByPlace[1] = inverse * glm::dvec2(-u.y, u.x);
  return facet;
}

//------------------------------------------------------------------------------
Outside PlaneImages::Facet::FindOutside(const glm::dvec2& place) const
{
  const glm::dvec2 way = place - this->Corners[0];
  return meniscus::FindOutside(
    { glm::dot(this->ByPlace[0], way), glm::dot(this->ByPlace[1], way) });
}

//------------------------------------------------------------------------------
// Writes the lengths of the legs behind a plane, if they are wanted.
void PlaneImages::WriteLegs(std::size_t plane, const ImageOutput& output) const
{
  if (!output.Legs)
  {
    return;
  }
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
  const std::vector<RefractionStack::Link>& links = this->Stack.GetLinks();
  const HeightFrame& frame = this->Planes.GetFrame();
  const PlaneLayer& first = this->Planes.GetLayers().front();
  const glm::dvec3 eye = this->Stack.GetOrigin() + this->Stack.GetEye();
  const glm::dvec3 toFirst = first.End * frame.Axis;
  const glm::dvec3 lastFoot = eye + this->Planes.GetLayers()[links.size() - 1].End * frame.Axis;
  for (int lane = 0; lane < this->Lanes.Count; ++lane)
  {
    const glm::dvec3 sight = toFirst + this->Lanes.First[0][lane] * frame.First +
      this->Lanes.First[1][lane] * frame.Second;
    // Eq. 2.4 over the length of the sight ray.
    const double behind =
      first.Index * this->Lanes.Optical[lane] * this->Lanes.FirstCosine[lane] / first.End;
    VirtualVertex& vertex = output.Vertices[this->Numbers[lane]];
    vertex.SightPoint = eye + sight;
    vertex.Position = vertex.SightPoint + behind * sight;
    vertex.Depth = this->Lanes.Geometric[lane];
    vertex.Reflectance = this->Lanes.Reflectance[lane];
    vertex.Cosine = this->Lanes.FirstCosine[lane];
    vertex.Facet = this->FirstFacet[lane];
    vertex.State = ImageState::Found;
    vertex.Orientation = 1;
    if (!output.Details)
    {
      continue;
    }
    StackDetail& detail = output.Details[this->Numbers[lane]];
    detail.LastSightPoint =
      lastFoot + this->Lanes.Last[0][lane] * frame.First + this->Lanes.Last[1][lane] * frame.Second;
    detail.Transmittance = 0.5 * (this->Lanes.Passed[0][lane] + this->Lanes.Passed[1][lane]);
    detail.Passed = static_cast<std::int32_t>(links.size());
  }
}

//------------------------------------------------------------------------------
// A point whose ray misses a plane has no image, unless it is in front of the planes within
// rounding.
void PlaneImages::WriteWithout(
  int lane, const ImageOutput& output, std::vector<std::size_t>& others) const
{
  const std::size_t number = this->Numbers[lane];
  const glm::dvec3& point = this->Points[lane];
  if (this->Meetings[lane] == Meeting::Open ||
    IsBeforeAll(this->Stack, point - this->Stack.GetOrigin()))
  {
    others.push_back(number);
    return;
  }
  output.Vertices[number] = VirtualVertex();
  output.Vertices[number].Position = point;
  if (!output.Details)
  {
    return;
  }
  output.Details[number] = StackDetail();
  double* const legs = output.Legs + output.LegsPerPoint * number;
  std::fill(legs, legs + output.LegsPerPoint, 0.0);
}

//------------------------------------------------------------------------------
void SolveBehindPlanes(const ParallelPlanes& planes, const double* points, std::size_t begin,
  std::size_t end, const ImageOutput& output, std::vector<std::size_t>& others)
{
  PlaneImages images(planes);
  for (std::size_t i = begin; i < end; ++i)
  {
    const double* p = points + 3 * i;
    if (!images.Add({ p[0], p[1], p[2] }, i))
    {
      others.push_back(i);
    }
    else if (images.IsFull())
    {
      images.Solve(output, others);
    }
  }
  images.Solve(output, others);
}

//------------------------------------------------------------------------------
bool SolveAtPlane(const ParallelPlanes& plane, const double* points, std::size_t begin,
  std::size_t end, VirtualVertex* vertices, unsigned char* isOpen)
{
  PlaneImages images(plane);
  const ImageOutput output{ vertices, nullptr, nullptr, 1 };
  std::vector<std::size_t> others;
  bool isAnyOpen = false;
  for (std::size_t i = begin; i < end; ++i)
  {
    const glm::dvec3 point(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    const glm::dvec3 local = point - plane.GetStack().GetOrigin();
    const bool isBehind = isOpen[i] && images.Add(point, i);
    const bool isInFront =
      isOpen[i] && !isBehind && plane.IsInReach(local) && plane.CountInFront(local) == 0;
    if (isInFront)
    {
      vertices[i] = VirtualVertex();
      vertices[i].Position = point;
    }
    isOpen[i] = isOpen[i] && !isBehind && !isInFront ? 1 : 0;
    isAnyOpen = isAnyOpen || isOpen[i];
    if (images.IsFull())
    {
      images.Solve(output, others);
    }
  }
  images.Solve(output, others);
  for (const std::size_t i : others)
  {
    isOpen[i] = 1;
  }
  return isAnyOpen || !others.empty();
}

}
