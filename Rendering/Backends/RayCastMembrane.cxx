// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/RayCastMembrane.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/StackValidation.h"
#include "Refraction/Stack/MediaChain.h"

#include <algorithm>
#include <utility>

namespace meniscus
{
namespace
{

/** The media of the interfaces; only of those that refract, if wanted. */
std::vector<InterfaceMedia> MediaOf(
  const std::vector<MembraneInterface>& interfaces, bool onlyRefracting)
{
  std::vector<InterfaceMedia> media;
  for (const MembraneInterface& interface : interfaces)
  {
    if (!onlyRefracting || interface.Exterior != interface.Interior)
    {
      media.push_back({ interface.Exterior, interface.Interior });
    }
  }
  return media;
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
std::string DescribeFault(const std::vector<MembraneInterface>& interfaces)
{
  const auto noSurface = std::find_if(interfaces.begin(), interfaces.end(),
    [](const MembraneInterface& interface) { return !interface.Surface; });
  if (noSurface != interfaces.end())
  {
    const auto number = static_cast<std::size_t>(noSurface - interfaces.begin());
    return NameInterface(number, interfaces.size()) + "The membrane is not a vtkPolyData";
  }
  const std::vector<InterfaceMedia> media = MediaOf(interfaces, false);
  const std::string fault = DescribeMediaFault(media);
  // The rays show whether they come from the back, unless the interface that does not match is not
  // traced.
  const bool fits = PassesFromFront(media) || !PassesFromFront(MediaOf(interfaces, true));
  return fault.empty() && !fits ? DescribeWrongSide() : fault;
}

}

//------------------------------------------------------------------------------
InputReport RayCastMembrane::Update(const std::vector<MembraneInterface>& interfaces, bool wanted)
{
  this->Used.clear();
  const std::string fault = DescribeFault(interfaces);
  if (!fault.empty())
  {
    return { fault, std::string() };
  }
  std::vector<UsedInterface> used;
  for (std::size_t i = 0; i < interfaces.size(); ++i)
  {
    std::size_t shape = 0;
    while (interfaces[shape].Surface != interfaces[i].Surface)
    {
      ++shape;
    }
    if (interfaces[i].Exterior != interfaces[i].Interior)
    {
      used.push_back({ shape, interfaces[i].Exterior, interfaces[i].Interior });
    }
  }
  if (used.empty() && wanted && !interfaces.empty())
  {
    used.push_back({ 0, interfaces[0].Exterior, interfaces[0].Interior });
  }
  InputReport report;
  for (const UsedInterface& interface : used)
  {
    const std::size_t number = interface.Shape;
    InputReport read =
      this->ReadShape(interfaces[number].Surface, number, NameInterface(number, interfaces.size()));
    if (!read.Error.empty())
    {
      return read;
    }
    report.Warning += read.Warning;
  }
  this->Used = std::move(used);
  this->FitsFromExterior = PassesFromFront(MediaOf(interfaces, true));
  return report;
}

//------------------------------------------------------------------------------
/** @param name beginning of its messages. */
InputReport RayCastMembrane::ReadShape(
  vtkPolyData* surface, std::size_t number, const std::string& name)
{
  while (this->Shapes.size() <= number)
  {
    this->Shapes.push_back(std::make_unique<SurfaceShape>());
  }
  SurfaceShape& shape = *this->Shapes[number];
  SceneMessages messages;
  if (!shape.Scene.SetMembrane(surface, true, messages))
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
  for (const std::unique_ptr<SurfaceShape>& shape : this->Shapes)
  {
    builds += shape->Scene.GetNumberOfPatchBuilds();
  }
  return TableVersion(builds);
}

//------------------------------------------------------------------------------
bool RayCastMembrane::Trace(RefractedRayField::View view, VolumeInput& input)
{
  view.Mesh = BoxOf(input.GetBoundaryTree(), view.Frame);
  const bool isStack = this->Used.size() > 1;
  if (this->SightShapes != this->GetShapeVersion() || this->SightOf != this->Used ||
    !(this->View == view))
  {
    this->View = view;
    if (isStack)
    {
      this->Sight.Clear();
      this->TraceStack(view);
    }
    else
    {
      this->Stack.Clear();
      view.Exterior = this->Used.front().Exterior;
      view.Interior = this->Used.front().Interior;
      const CurvedMembraneSolver& surface =
        this->Shapes[this->Used.front().Shape]->Scene.GetCurved();
      this->Sight.Build(surface.GetMembrane(), surface.GetPatches(), view, ThreadedLoop);
    }
    this->SightOf = this->Used;
    this->SightShapes = this->GetShapeVersion();
    this->Frames.Turn(this->GetLegs(),
      isStack ? this->Stack.GetMeanDirection() : this->Sight.GetMeanDirection(), ThreadedLoop,
      isStack ? this->Stack.GetStepBounds() : this->Sight.GetStepBounds());
    this->SightVersion.Bump();
  }
  return isStack ? this->Stack.IsSeen() : this->Sight.IsSeen();
}

//------------------------------------------------------------------------------
std::string RayCastMembrane::DescribeMismatch() const
{
  return !this->FitsFromExterior && this->GetCounts().Mismatched > 0 ? DescribeWrongSide()
                                                                     : std::string();
}

//------------------------------------------------------------------------------
void RayCastMembrane::TraceStack(const RefractedRayField::View& view)
{
  std::vector<StackedInterface> interfaces;
  for (const UsedInterface& used : this->Used)
  {
    SurfaceShape& shape = *this->Shapes[used.Shape];
    const CurvedMembraneSolver& surface = shape.Scene.GetCurved();
    if (shape.TreeOf != shape.Scene.GetNumberOfPatchBuilds())
    {
      shape.Tree.Build(surface.GetMembrane(), surface.GetPatches(), ThreadedLoop);
      shape.TreeOf = shape.Scene.GetNumberOfPatchBuilds();
    }
    interfaces.push_back(
      { &surface.GetMembrane(), &surface.GetPatches(), &shape.Tree, used.Exterior, used.Interior });
  }
  this->Stack.Build(interfaces, view, ThreadedLoop);
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
  RefractedRayStack::Counts counts =
    isCurrent ? this->Stack.GetCounts() : this->Stack.GetCountsOfTraced();
  counts.Undecided += this->Sight.GetNumberOfUndecidedRays();
  return counts;
}

//------------------------------------------------------------------------------
std::vector<const RefractedRayTiles*> RayCastMembrane::ListRefracted() const
{
  if (this->SightOf.size() < 2)
  {
    return { &this->Sight.GetRays() };
  }
  std::vector<const RefractedRayTiles*> list;
  for (const RefractedRayTiles& rays : this->Stack.GetRays())
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
