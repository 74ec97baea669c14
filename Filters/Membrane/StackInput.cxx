// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/StackInput.h"

#include "Filters/Interface/StackValidation.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObject.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace meniscus
{

//------------------------------------------------------------------------------
bool HasStack(vtkRefractingInterfaceCollection* interfaces, vtkInformationVector* surfaces)
{
  return interfaces->GetNumberOfItems() > 1 || surfaces->GetNumberOfInformationObjects() > 1;
}

//------------------------------------------------------------------------------
std::string FindModelFault(bool curved)
{
  return curved ? std::string() : "Several refracting interfaces need the membrane model CURVED";
}

//------------------------------------------------------------------------------
std::vector<vtkPolyData*> ListSurfaces(vtkInformationVector* port, SceneMessages& messages)
{
  std::vector<vtkPolyData*> surfaces;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    surfaces.push_back(vtkPolyData::GetData(port, i));
    if (!surfaces.back())
    {
      messages.Error = "A surface at the membrane port is missing or is not a vtkPolyData";
    }
  }
  return surfaces;
}

//------------------------------------------------------------------------------
bool UpdateStack(StackScene& scene, vtkInformationVector* port, int number,
  vtkRefractingInterfaceCollection* interfaces, const std::array<double, 3>& eye,
  SceneMessages& messages)
{
  return UpdateSurfaces(scene, port, number, interfaces, messages) && scene.SetEye(eye, messages);
}

//------------------------------------------------------------------------------
bool UpdateSurfaces(StackScene& scene, vtkInformationVector* port, int number,
  vtkRefractingInterfaceCollection* interfaces, SceneMessages& messages)
{
  const std::string fault =
    FindStackFault(interfaces, port->GetNumberOfInformationObjects(), number);
  messages.Error = fault.empty() ? messages.Error : fault;
  std::vector<vtkPolyData*> surfaces;
  if (messages.Error.empty())
  {
    surfaces = ListSurfaces(port, messages);
  }
  return messages.Error.empty() && scene.SetInterfaces(surfaces, interfaces, messages);
}

//------------------------------------------------------------------------------
void RequestWhole(vtkInformationVector* port)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* surface = port->GetInformationObject(i);
    surface->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    surface->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    surface->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    // The executive copies the extent of other data, which a surface has only if it comes from an
    // image.
    surface->Remove(Pipeline::UPDATE_EXTENT());
  }
}

//------------------------------------------------------------------------------
void Report(vtkObject* owner, const SceneMessages& messages)
{
  if (!messages.Error.empty())
  {
    vtkErrorWithObjectMacro(owner, << messages.Error << "; the output is empty.");
  }
  if (!messages.Warning.empty())
  {
    vtkWarningWithObjectMacro(owner, << messages.Warning);
  }
}

}
