// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTruePositionFilter.h"

#include "MembraneGathering.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVTruePositionFilter);
meniscusInterfaceTableMacro(vtkPVTruePositionFilter);

//------------------------------------------------------------------------------
vtkPVTruePositionFilter::vtkPVTruePositionFilter()
{
  this->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
vtkPVTruePositionFilter::~vtkPVTruePositionFilter() = default;

//------------------------------------------------------------------------------
void vtkPVTruePositionFilter::SetExactMembrane(vtkImplicitFunction* function)
{
  this->Table.SetExactSurface(function);
}

//------------------------------------------------------------------------------
int vtkPVTruePositionFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  meniscus::AcceptComposite(info);
  return filled;
}

//------------------------------------------------------------------------------
int vtkPVTruePositionFilter::FillOutputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVTruePositionFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return meniscus::MakeOutputLikeInput(inputs[0], outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

//------------------------------------------------------------------------------
int vtkPVTruePositionFilter::ComputeInputUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int succeeded = this->Superclass::ComputeInputUpdateExtent(request, inputs, outputs);
  meniscus::AskForPiece(inputs[1], outputs);
  return succeeded;
}

//------------------------------------------------------------------------------
int vtkPVTruePositionFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  std::string fault;
  const auto membranes = this->Table.GatherSurfaces(inputs[1], false, fault);
  if (!membranes)
  {
    vtkErrorMacro(<< fault << "; the output is empty.");
    return 0;
  }
  return meniscus::RunBlocks("vtkPointSet", inputs, outputs, membranes,
    [this, request](vtkInformationVector** ports, vtkInformationVector* output)
    { return this->Superclass::RequestData(request, ports, output); });
}

//------------------------------------------------------------------------------
void vtkPVTruePositionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
