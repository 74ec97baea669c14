// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRefractionErrorVolume.h"

#include "MembraneGathering.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkPVRefractionErrorVolume);

//------------------------------------------------------------------------------
vtkPVRefractionErrorVolume::vtkPVRefractionErrorVolume() = default;

//------------------------------------------------------------------------------
vtkPVRefractionErrorVolume::~vtkPVRefractionErrorVolume() = default;

//------------------------------------------------------------------------------
int vtkPVRefractionErrorVolume::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  meniscus::AcceptComposite(info);
  return filled;
}

//------------------------------------------------------------------------------
int vtkPVRefractionErrorVolume::RequestUpdateExtent(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Each rank asks for its own piece of the membranes, whatever part of the box it measures.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* output = outputs->GetInformationObject(0);
  for (int port = 0; port < 2; ++port)
  {
    if (vtkInformation* info = inputs[port]->GetInformationObject(0))
    {
      info->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
      info->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      info->Remove(Pipeline::UPDATE_EXTENT());
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVRefractionErrorVolume::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkSmartPointer<vtkInformationVector> gathered[2];
  for (int port = 0; port < 2; ++port)
  {
    if (!inputs[port]->GetInformationObject(0))
    {
      gathered[port] = inputs[port];
      continue;
    }
    const vtkSmartPointer<vtkPolyData> membrane =
      meniscus::GatherMembrane(vtkDataObject::GetData(inputs[port]));
    if (!membrane)
    {
      vtkErrorMacro(
        "The ranks could not exchange their parts of the membrane; the output is empty.");
      return 0;
    }
    gathered[port] = meniscus::WrapData(membrane);
  }
  vtkInformationVector* ports[] = { gathered[0], gathered[1] };
  return this->Superclass::RequestData(request, ports, outputs);
}

//------------------------------------------------------------------------------
void vtkPVRefractionErrorVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
