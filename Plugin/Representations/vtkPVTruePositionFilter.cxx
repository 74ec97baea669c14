// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTruePositionFilter.h"

#include "MembraneGathering.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

//------------------------------------------------------------------------------
vtkPVTruePositionFilter::vtkPVTruePositionFilter()
{
  this->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
void vtkPVTruePositionFilter::SetExactMembrane(vtkImplicitFunction* function)
{
  this->Table.SetExactSurface(function);
}

meniscusBlockPortsMacro(
  vtkPVTruePositionFilter, ComputeInputUpdateExtent, "vtkPointSet", static_cast<void>(0));
