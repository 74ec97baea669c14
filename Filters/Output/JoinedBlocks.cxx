// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/JoinedBlocks.h"

#include "vtkAppendPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkSmartPointer.h"

namespace meniscus
{

//------------------------------------------------------------------------------
vtkPolyData* JoinedBlocks::Get(vtkDataObject* output)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(output);
  if (!blocks)
  {
    return vtkPolyData::SafeDownCast(output);
  }
  if (this->Time < blocks->GetMTime())
  {
    vtkNew<vtkAppendPolyData> append;
    const auto block = vtk::TakeSmartPointer(blocks->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
    {
      append->AddInputData(vtkPolyData::SafeDownCast(block->GetCurrentDataObject()));
    }
    if (append->GetNumberOfInputConnections(0) > 0)
    {
      append->Update();
    }
    this->Joined->ShallowCopy(append->GetOutput());
    this->Time = blocks->GetMTime();
  }
  return this->Joined;
}

}
