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

meniscusBlockPortsMacro(vtkPVTruePositionFilter, ComputeInputUpdateExtent);

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
