// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/RefractionPassList.h"

#include "Rendering/Pass/TrueSpaceLighting.h"
#include "Rendering/Pass/ViewBounds.h"

#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include "vtkAlgorithm.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
vtkPolyDataMapper* Refraction::GetMapper() const
{
  auto* actor = vtkActor::SafeDownCast(this->Object);
  return actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr;
}

//------------------------------------------------------------------------------
bool Refraction::CastsShadows() const
{
  auto* actor = vtkActor::SafeDownCast(this->Object);
  return this->Filter && !this->IsReflection && actor && this->GetMapper() &&
    actor->GetVisibility() && actor->GetProperty()->GetRepresentation() == VTK_SURFACE &&
    !actor->HasTranslucentPolygonalGeometry();
}

//------------------------------------------------------------------------------
std::vector<double> Refraction::ListRelativeIndices() const
{
  if (this->Filter)
  {
    return this->Filter->GetRelativeIndicesOfRefraction();
  }
  vtkTetrahedraRayCastMapper* mapper = RayCasterOf(this->GetVolume());
  vtkRefractingInterfaceCollection* interfaces = mapper ? mapper->GetInterfaces() : nullptr;
  if (!interfaces)
  {
    return { 1.0 };
  }
  const double exterior = interfaces->GetFirstInterface()->GetExteriorIndexOfRefraction();
  std::vector<double> indices;
  for (int i = 0; i < interfaces->GetNumberOfItems(); ++i)
  {
    indices.push_back(interfaces->GetInterface(i)->GetInteriorIndexOfRefraction() / exterior);
  }
  return indices;
}

//------------------------------------------------------------------------------
SeenThrough Refraction::ListSeenThrough(const RefractionMedium& medium) const
{
  // Known before the filter has run.
  const bool isOne = this->Filter && this->Filter->GetInterfaces()->GetNumberOfItems() < 2;
  return { !medium.IsClear(), !isOne };
}

//------------------------------------------------------------------------------
std::string Refraction::ChooseLighting(bool isWanted)
{
  auto* object = vtkActor::SafeDownCast(this->Object);
  vtkPolyDataMapper* mapper = this->GetMapper();
  this->IsLitInTrueSpace = isWanted && mapper && this->Filter && !this->IsReflection &&
    object->GetProperty()->GetLighting();
  std::string missing;
  if (this->IsLitInTrueSpace)
  {
    mapper->GetInputAlgorithm()->Update();
    missing = TrueSpaceLighting::DescribeMissing(object);
    this->IsLitInTrueSpace = missing.empty();
  }
  if (this->IsLitInTrueSpace)
  {
    vtkPolyData* data = mapper->GetInput();
    const bool hasLast = data && data->GetPointData()->HasArray("LastSightPoint");
    const std::string name = hasLast ? "LastSightPoint" : "SightPoint";
    if (name != this->SightArray)
    {
      this->SightArray = name;
      MapTrueArrays(mapper, name);
    }
  }
  const bool isNew = missing != this->LightingError;
  this->LightingError = missing;
  return isNew ? missing : std::string();
}

//------------------------------------------------------------------------------
void Refraction::PreparePlaces(vtkRenderer* renderer, LocalPlaces& places) const
{
  // The middle of the object, not of its images, is the same for each camera.
  places.Prepare(static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow()),
    this->GetMapper()->GetInput(), { "TruePosition", this->SightArray },
    LocalPlaces::MiddleOf(this->Filter->GetInputDataObject(0, 0)));
}

//------------------------------------------------------------------------------
std::vector<vtkActor*> RefractionList::ListMembranes() const
{
  std::vector<vtkActor*> membranes;
  for (const Refraction& refraction : this->All)
  {
    if (std::find(membranes.begin(), membranes.end(), refraction.Membrane) == membranes.end())
    {
      membranes.push_back(refraction.Membrane);
    }
  }
  return membranes;
}

//------------------------------------------------------------------------------
std::vector<vtkProp*> RefractionList::ListObjects(vtkActor* membrane, bool areReflections) const
{
  std::vector<vtkProp*> props;
  for (const Refraction& refraction : this->All)
  {
    if (refraction.Filter && refraction.IsReflection == areReflections &&
      refraction.Membrane == membrane && refraction.Object->GetVisibility())
    {
      props.push_back(refraction.Object);
    }
  }
  return props;
}

//------------------------------------------------------------------------------
bool RefractionList::HasVolume(vtkActor* membrane) const
{
  return std::any_of(this->All.begin(), this->All.end(),
    [membrane](const Refraction& one) { return one.Membrane == membrane && one.GetVolume(); });
}

//------------------------------------------------------------------------------
const Refraction& RefractionList::FirstOf(vtkActor* membrane) const
{
  return *std::find_if(this->All.begin(), this->All.end(),
    [membrane](const Refraction& one) { return one.Membrane == membrane; });
}

//------------------------------------------------------------------------------
const Refraction* RefractionList::Find(vtkProp* object) const
{
  const auto found = std::find_if(this->All.begin(), this->All.end(),
    [object](const Refraction& one) { return one.Object == object; });
  return found == this->All.end() ? nullptr : &*found;
}

//------------------------------------------------------------------------------
void RefractionList::Remove(vtkProp3D* object)
{
  this->All.erase(std::remove_if(this->All.begin(), this->All.end(),
                    [object](const Refraction& one) { return one.Object == object; }),
    this->All.end());
}

//------------------------------------------------------------------------------
/** Membranes come first: objects behind a membrane that is out of view are ignored. */
void RefractionList::AdjustClippingRange(vtkRenderer* renderer) const
{
  for (vtkActor* membrane : this->ListMembranes())
  {
    const double* bounds = membrane->GetVisibility() ? membrane->GetBounds() : nullptr;
    if (!bounds)
    {
      continue;
    }
    HoldInClippingRange(renderer, bounds);
    const bool inView = bounds[0] <= bounds[1] && MayBeInView(renderer, bounds);
    for (const Refraction& refraction : this->All)
    {
      if (inView && refraction.Membrane == membrane && refraction.Object->GetVisibility())
      {
        HoldInClippingRange(renderer, refraction.Object->GetBounds());
      }
    }
  }
}

}
