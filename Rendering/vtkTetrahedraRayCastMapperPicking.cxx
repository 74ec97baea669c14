// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Places on rays for vtkTetrahedraRayCastMapper: picks, and depths of frames.
#include "Rendering/RayCastMapperInternals.h"
#include "Rendering/VolumePick.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkDataObject.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <memory>
#include <string>

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::UpdateForPick(
  vtkRenderer* renderer, vtkVolume* volume, meniscus::InputBlocks& parts)
{
  vtkInternals& internals = *this->Internals;
  if (this->GetNumberOfInputConnections(0) == 0 || !this->CollectInput(parts) ||
    parts.Parts.empty() || !this->ChooseMixture(parts, volume))
  {
    return false;
  }
  if (!internals.Picker)
  {
    internals.Picker = std::make_unique<meniscus::RayPicker>();
  }
  if (!this->UpdateMembrane(internals.Picker->Membrane) ||
    !this->UpdateInput(renderer->GetRenderWindow(), volume, parts))
  {
    return false;
  }
  internals.SetPlace(volume);
  this->UpdateTransferFunction();
  // A mesh without extent has no cell that a ray could cross.
  const meniscus::TetrahedralMesh& mesh = internals.Input.GetMesh();
  if (mesh.GetNumberOfActiveCells() == 0 || mesh.GetRadius() == 0.0)
  {
    return false;
  }
  internals.Input.FindInputCells(parts);
  return true;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::CastPick(
  vtkRenderer* renderer, vtkVolume* volume, meniscus::VolumePick& pick)
{
  vtkInternals& internals = *this->Internals;
  meniscus::InputBlocks parts;
  if (!this->UpdateForPick(renderer, volume, parts))
  {
    return false;
  }
  meniscus::RayCastFrame frame;
  frame.Output.ImageSize[0] = pick.ViewportSize[0];
  frame.Output.ImageSize[1] = pick.ViewportSize[1];
  std::string error = this->PrepareView(renderer, volume, frame);
  meniscus::MeasuredEvents events;
  if (error.empty())
  {
    internals.UpdateGradients(parts, frame.Optics);
    error = internals.Picker->Cast(internals, frame, pick.Pixel, pick.Opacity, events);
  }
  if (!error.empty())
  {
    vtkErrorMacro("Nothing is picked: " << error << ".");
    return false;
  }
  const meniscus::InputCells cells(this->GetDataObjectInput(), parts);
  const meniscus::EventContext context{ cells, internals.Input.GetInputCells(),
    internals.Input.GetNormalization(), meniscus::IndicesOf(internals.Property.GetIsosurfaces()),
    frame.Refracting.Center, frame.Rays.ViewToWorld };
  bool isAny = false;
  for (std::size_t kind = 0; kind < pick.Places.size(); ++kind)
  {
    meniscus::PickedPlace& place = pick.Places[kind];
    place.IsFound = events.Events[kind].IsFound();
    if (place.IsFound)
    {
      place.Event = meniscus::ConvertEvent(events.Events[kind], context);
      place.DataSet = parts.Parts[place.Event.Cell.Part].Grid;
      isAny = true;
    }
  }
  return isAny;
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::WriteDepths(const meniscus::RayCastFrame& frame)
{
  vtkInternals& internals = *this->Internals;
  if (!internals.DepthCaster)
  {
    internals.DepthCaster = std::make_unique<meniscus::RayPicker>();
  }
  // A frame that shows the last image again has its depths, too.
  if (internals.DepthsOfCast != internals.GetNumberOfCasts())
  {
    if (!this->UpdateMembrane(internals.DepthCaster->Membrane))
    {
      return "no depths without a usable membrane";
    }
    const auto kind = this->DepthWriting == FIRST_VISIBLE_DEPTH ? meniscus::FirstVisibleEvent
                                                                : meniscus::OpacityReachedEvent;
    const std::string error = internals.DepthCaster->CastDepths(
      internals, frame, this->DepthOpacity, kind, internals.Depths);
    if (!error.empty())
    {
      return error;
    }
    internals.DepthsOfCast = internals.GetNumberOfCasts();
  }
  return internals.GetPresenter().WriteDepths(internals.Depths, frame.Output.ImageSize);
}
