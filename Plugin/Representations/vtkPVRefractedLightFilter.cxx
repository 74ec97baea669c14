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

meniscusBlockPortsMacro(vtkPVRefractedLightFilter, RequestUpdateExtent, "vtkPolyData",
  this->OtherGeometry = BoundsOfAll(vtkDataObject::GetData(inputs[0])));
