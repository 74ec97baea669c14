// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/RayCastMembrane.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Volume/Mesh/InvertedCells.h"

#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace meniscus
{
namespace
{

/** Parts of the mesh's boundary whose bounds tell which rays show nothing of it. */
constexpr std::size_t NumberOfParts = 32;

/** Media of the interfaces that refract. */
std::vector<InterfaceMedia> FindRefracting(const std::vector<InterfaceMedia>& media)
{
  std::vector<InterfaceMedia> refracting;
  std::copy_if(media.begin(), media.end(), std::back_inserter(refracting),
    [](const InterfaceMedia& one) { return one.IsRefracting(); });
  return refracting;
}

/** True if rays that come to the front of the first interface can pass all of them. */
bool PassesFromFront(const std::vector<InterfaceMedia>& media)
{
  const MediaChain chain(media);
  return media.empty() || (!chain.Ways.empty() && chain.Ways.front().front().FromFront);
}

/** Text of the error for media that rays cannot pass from the front of the first interface. */
std::string DescribeWrongSide()
{
  return std::string(MismatchText) +
    "the medium behind each interface must be that of a side of the next one";
}

/** Error in a list that is found without reading the surfaces; empty if there is none. */
std::string DescribeFault(
  const std::vector<vtkPolyData*>& surfaces, const std::vector<InterfaceMedia>& media)
{
  const auto noSurface = std::find(surfaces.begin(), surfaces.end(), nullptr);
  if (noSurface != surfaces.end())
  {
    const auto number = static_cast<std::size_t>(noSurface - surfaces.begin());
    return NameInterface(number, surfaces.size()) + "The membrane is not a vtkPolyData";
  }
  const std::string fault = DescribeMediaFault(media);
  // The rays show whether they come from the back, unless the interface that does not match is not
  // traced.
  const bool fits = PassesFromFront(media) || !PassesFromFront(FindRefracting(media));
  return fault.empty() && !fits ? DescribeWrongSide() : fault;
}

}

//------------------------------------------------------------------------------
InputReport RayCastMembrane::Update(const std::vector<vtkPolyData*>& surfaces,
  vtkRefractingInterfaceCollection* interfaces, bool wanted)
{
  this->Used.clear();
  const std::size_t count = surfaces.size();
  const auto items = static_cast<std::size_t>(interfaces->GetNumberOfItems());
  if (count != items && (count > 0 || items > 1))
  {
    return { DescribeCounts(static_cast<int>(items), static_cast<int>(count), 1), std::string() };
  }
  std::vector<InterfaceMedia> media = ListMedia(interfaces);
  media.resize(count); // the interface of an owner without a membrane is not used
  const std::string fault = DescribeFault(surfaces, media);
  if (!fault.empty())
  {
    return { fault, std::string() };
  }
  const std::vector<InterfaceMedia> refracting = FindRefracting(media);
  const bool isShown = wanted && refracting.empty(); // the first interface, without refraction
  this->Shapes.resize(std::max(this->Shapes.size(), count));
  InputReport report;
  std::vector<Interface> used;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (media[i].IsRefracting() || (isShown && i == 0))
    {
      const auto first = std::find(surfaces.begin(), surfaces.end(), surfaces[i]);
      const auto number = static_cast<std::size_t>(first - surfaces.begin());
      InputReport read = this->ReadShape(surfaces[i], number, NameInterface(number, count));
      if (!read.Error.empty())
      {
        return read;
      }
      report.Warning += read.Warning;
      used.push_back({ this->Shapes[number].Source.GetSurface(), media[i] });
    }
  }
  this->Used = std::move(used);
  this->FitsFromExterior = PassesFromFront(refracting);
  return report;
}

//------------------------------------------------------------------------------
/** @param name beginning of its messages. */
InputReport RayCastMembrane::ReadShape(
  vtkPolyData* surface, std::size_t number, const std::string& name)
{
  Shape& shape = this->Shapes[number];
  if (!shape.Source.Update(surface, nullptr, true))
  {
    return {};
  }
  SceneMessages messages;
  if (!shape.Source.Report(messages))
  {
    return { name + messages.Error, std::string() };
  }
  if (messages.Warning.empty() || messages.Warning == shape.Told)
  {
    return {};
  }
  shape.Told = messages.Warning;
  return { std::string(), name + messages.Warning };
}

//------------------------------------------------------------------------------
TableVersion RayCastMembrane::GetShapeVersion() const
{
  std::int64_t builds = 0;
  for (const Shape& shape : this->Shapes)
  {
    builds += shape.Source.GetNumberOfBuilds();
  }
  return TableVersion(builds);
}

//------------------------------------------------------------------------------
bool RayCastMembrane::Trace(RefractedRayStack::View view, VolumeInput& input)
{
  view.Mesh = BoxOf(input.GetBoundaryTree(), view.Frame);
  // Without further active cells no ray shows more: parts of the mesh that it has lost do no harm.
  const bool isWithin = this->SightMesh == input.GetMeshVersion() &&
    (this->SightLinks == input.GetLinkVersion() ||
      input.GetMesh().GetActiveCells().IsWithin(this->SightCells));
  view.Parts =
    isWithin ? this->View.Parts : PartsOf(input.GetBoundaryTree(), view.Frame, NumberOfParts);
  this->SightLinks = input.GetLinkVersion();
  if (this->SightShapes != this->GetShapeVersion() || !(this->SightOf == this->Used) ||
    !(this->View == view))
  {
    view.Parts = PartsOf(input.GetBoundaryTree(), view.Frame, NumberOfParts);
    this->View = view;
    this->SightMesh = input.GetMeshVersion();
    this->SightCells = input.GetMesh().GetActiveCells();
    for (Shape& shape : this->Shapes)
    {
      shape.Source.GetSurface()->Prepare(RefractedRayStack::NeededParts, ThreadedLoop);
    }
    this->Rays.Build(this->Used, view, ThreadedLoop);
    this->SightOf = this->Used;
    this->SightShapes = this->GetShapeVersion();
    this->Frames.Turn(
      this->GetLegs(), this->Rays.GetMeanDirection(), ThreadedLoop, this->Rays.GetStepBounds());
    this->SightVersion.Bump();
  }
  return this->Rays.IsSeen();
}

//------------------------------------------------------------------------------
std::string RayCastMembrane::DescribeMismatch() const
{
  return !this->FitsFromExterior && this->GetCounts().Mismatched > 0 ? DescribeWrongSide()
                                                                     : std::string();
}

//------------------------------------------------------------------------------
/**
 * True if the first interface is an open surface none of whose facets shows the eye the side from
 * which rays pass the list.
 */
bool RayCastMembrane::IsOnWrongSide() const
{
  std::vector<InterfaceMedia> media;
  std::transform(this->Used.begin(), this->Used.end(), std::back_inserter(media),
    [](const Interface& one) { return one.Media; });
  const MediaChain chain(media);
  if (this->Used.empty() || !media.front().IsRefracting() || chain.Ways.empty())
  {
    return false;
  }
  // Parallel rays come from far away, where the eye of vtkRefractedGeometryFilter is then.
  constexpr double distance = 1e5;
  const Membrane& surface = this->Used.front().Surface->GetMembrane();
  const RayFrame& frame = this->View.Frame;
  const bool isParallel =
    frame.Slope.PerColumn == glm::dvec2(0.0) && frame.Slope.PerRow == glm::dvec2(0.0);
  const glm::dvec3 step(frame.Slope.At(0.0, 0.0), 1.0);
  const glm::dvec3 start = glm::dvec3(frame.Origin.At(0.0, 0.0), 0.0) + this->View.EyeDepth * step;
  const glm::dvec3 along = glm::normalize(frame.ViewToWorld * step);
  const glm::dvec3 eye = this->View.Center - surface.GetOrigin() + frame.ViewToWorld * start -
    (isParallel ? distance * surface.GetRadius() : 0.0) * along;
  return !surface.IsClosed() && std::isfinite(eye.x + eye.y + eye.z) &&
    !surface.ShowsSide(eye, chain.Ways.front().front().FromFront ? 1.0 : -1.0);
}

//------------------------------------------------------------------------------
std::string RayCastMembrane::WarnOfSide()
{
  const bool isWrong = this->IsOnWrongSide();
  const bool isNew = isWrong && !this->IsSideReported;
  this->IsSideReported = isWrong;
  return isNew
    ? "No facet of the " + std::string(this->Used.size() > 1 ? "first membrane" : "membrane") +
      " faces the eye: its normals point to the other side, and rays come from the medium behind "
      "it. Unless the eye is really there, reverse the normals and the order of the corners."
    : std::string();
}

//------------------------------------------------------------------------------
RefractedRayStack::Counts RayCastMembrane::GetCounts() const
{
  if (this->Used.empty())
  {
    return {};
  }
  // Rays are only traced through the surfaces that the image is of.
  const bool isCurrent = this->SightShapes == this->GetShapeVersion();
  return isCurrent ? this->Rays.GetCounts() : this->Rays.GetCountsOfTraced();
}

//------------------------------------------------------------------------------
std::vector<const RefractedRayTiles*> RayCastMembrane::ListRefracted() const
{
  std::vector<const RefractedRayTiles*> list;
  for (const RefractedRayTiles& rays : this->Rays.GetRays())
  {
    list.push_back(&rays);
  }
  return list;
}

//------------------------------------------------------------------------------
RayLegs RayCastMembrane::GetLegs() const
{
  return RayLegs(this->View.Frame, this->View.Width, this->View.Height, this->ListRefracted());
}

//------------------------------------------------------------------------------
bool RayCastMembrane::BeginsInside(VolumeInput& input)
{
  if (this->InvertedOf != input.GetMeshVersion())
  {
    this->Inverted = HasInvertedCells(input.GetMesh(), ThreadedLoop);
    this->InvertedOf = input.GetMeshVersion();
  }
  return !this->Inverted;
}

//------------------------------------------------------------------------------
RefractedScene RayCastMembrane::See(VolumeInput& input)
{
  const TableVersions version{ input.GetMeshVersion(), input.GetScalarVersion(),
    this->SightVersion };
  if (version != this->Placed)
  {
    this->Frames.Place(input.GetMesh(), input.GetScalars(), ThreadedLoop);
    this->Placed = version;
  }
  RefractedScene scene;
  scene.BeginsInside = this->BeginsInside(input);
  scene.Legs = this->ListRefracted();
  scene.Frames = &this->Frames;
  scene.Tree = &input.GetBoundaryTree();
  return scene;
}

}
