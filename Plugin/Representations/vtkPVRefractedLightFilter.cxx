// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRefractedLightFilter.h"

#include "MembraneGathering.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkPVRefractedLightFilter);
meniscusInterfaceTableMacro(vtkPVRefractedLightFilter);

namespace
{

/** Bounds of the polygonal blocks of all ranks. Must be called by all of them alike. */
vtkBoundingBox BoundsOfAll(vtkDataObject* local)
{
  vtkBoundingBox box;
  const auto add = [&box](vtkDataObject* data)
  {
    auto* geometry = vtkPolyData::SafeDownCast(data);
    if (geometry && geometry->GetNumberOfPoints() > 0)
    {
      box.AddBounds(geometry->GetBounds());
    }
  };
  add(local);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(local))
  {
    auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
    {
      add(block->GetCurrentDataObject());
    }
  }
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    const vtkBoundingBox own = box;
    controller->AllReduce(own, box);
  }
  return box;
}

}

//------------------------------------------------------------------------------
vtkPVRefractedLightFilter::vtkPVRefractedLightFilter()
{
  this->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
vtkPVRefractedLightFilter::~vtkPVRefractedLightFilter() = default;

meniscusBlockPortsMacro(vtkPVRefractedLightFilter, RequestUpdateExtent);

//------------------------------------------------------------------------------
int vtkPVRefractedLightFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  std::string fault;
  const auto membranes = this->Table.GatherSurfaces(inputs[1], false, fault);
  if (!membranes)
  {
    vtkErrorMacro(<< fault << "; the output is empty.");
    return 0;
  }
  this->OtherGeometry = BoundsOfAll(vtkDataObject::GetData(inputs[0]));
  return meniscus::RunBlocks("vtkPolyData", inputs, outputs, membranes,
    [this, request](vtkInformationVector** ports, vtkInformationVector* output)
    { return this->Superclass::RequestData(request, ports, output); });
}

//------------------------------------------------------------------------------
void vtkPVRefractedLightFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
